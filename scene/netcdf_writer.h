// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace spindrift::scene
{

/// A NetCDF-4 file that is written aside, brought to the disk by close(), and only then takes its name. An
/// object that is not closed leaves nothing behind. Failures throw Error with file and reason.
class NetcdfWriter
{
  public:
    explicit NetcdfWriter(std::filesystem::path file);
    ~NetcdfWriter();
    NetcdfWriter(const NetcdfWriter&) = delete;
    NetcdfWriter& operator=(const NetcdfWriter&) = delete;

    void dimension(const std::string& name, std::size_t length);  ///< 0: unlimited
    /// `type`: nc_type. Attributes are written as text.
    void variable(const std::string& name, int type, const std::vector<std::string>& dimensions,
                  const std::vector<std::pair<std::string, std::string>>& attributes = {});
    void attribute(const std::string& name, const std::string& text);  ///< of the file
    void end_definitions();

    /// All of a variable, or its first time slice if its first dimension is unlimited.
    void put(const std::string& name, const std::vector<float>& values);
    void put(const std::string& name, const std::vector<double>& values);
    void put(const std::string& name, const std::vector<int>& values);
    void put(const std::string& name, const std::string& text);

    void close();

  private:
    void check(int status, const std::string& what) const;
    template <class T, class Put>
    void put_slice(const std::string& name, const T* values, std::size_t count, Put put);

    std::filesystem::path file_, aside_;
    int id_ = -1;
};

}  // namespace spindrift::scene
