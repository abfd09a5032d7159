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

    /// The first time slice, slowest dimension first; `shape` must be what the file says. Throws if a number
    /// is not finite or larger than 1e6 (fill values are 1e36).
    std::vector<float> read(const std::string& variable, const std::vector<std::size_t>& expected) const;

  private:
    int id_of(const std::string& variable) const;
    [[noreturn]] void fail(const std::string& variable, const std::string& reason) const;

    std::string name_;
    int id_ = -1;
};

}  // namespace spindrift::scene
