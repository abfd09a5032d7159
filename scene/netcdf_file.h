// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace spindrift::scene
{

/// A NetCDF file open for reading. Every failure throws Error naming the file, the variable and the reason.
class NetcdfFile
{
  public:
    explicit NetcdfFile(const std::filesystem::path& file);
    ~NetcdfFile();
    NetcdfFile(const NetcdfFile&) = delete;
    NetcdfFile& operator=(const NetcdfFile&) = delete;

    const std::string& name() const { return name_; }
    bool has(const std::string& variable) const;

    /// Lengths of a variable's dimensions, slowest first, without a leading time dimension "t".
    std::vector<std::size_t> shape(const std::string& variable) const;

    /// Length of the time dimension "t" of a variable; 1 for one without it.
    std::size_t slices(const std::string& variable) const;

    /// One time slice (the only one, of a variable without time), slowest dimension first; `expected` must be
    /// what the file says. Throws if a number is not finite or larger than 1e6 (fill values are 1e36).
    std::vector<float> read(const std::string& variable, const std::vector<std::size_t>& expected,
                            std::size_t slice = 0) const;

    /// A list of `count` finite numbers, of any size: times.
    std::vector<double> read_times(const std::string& variable, std::size_t count) const;

  private:
    struct Shape
    {
        std::size_t slices = 0;  ///< 0: no time dimension
        std::vector<std::size_t> lengths;
    };
    Shape find_shape(const std::string& variable) const;
    int id_of(const std::string& variable) const;
    [[noreturn]] void fail(const std::string& variable, const std::string& reason) const;

    std::string name_;
    int id_ = -1;
};

}  // namespace spindrift::scene
