// SPDX-License-Identifier: MIT
#include "scene/netcdf_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <netcdf.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace spindrift::scene
{

NetcdfFile::NetcdfFile(const std::filesystem::path& file) : name_(file.string())
{
    std::error_code failed;
    if (!std::filesystem::exists(file, failed)) throw Error(fmt::format("{}: no such wind file", name_));
    if (!std::filesystem::is_regular_file(file, failed))
        throw Error(fmt::format("{} is not a plain file; name a NetCDF file", name_));
    if (const int status = nc_open(name_.c_str(), NC_NOWRITE, &id_); status != NC_NOERR)
        throw Error(
            fmt::format("{} cannot be read as NetCDF ({}); it may be cut off", name_, nc_strerror(status)));
}

NetcdfFile::~NetcdfFile()
{
    nc_close(id_);
}

void NetcdfFile::fail(const std::string& variable, const std::string& reason) const
{
    throw Error(fmt::format("{}: variable '{}' {}", name_, variable, reason));
}

bool NetcdfFile::has(const std::string& variable) const
{
    int id = 0;
    return nc_inq_varid(id_, variable.c_str(), &id) == NC_NOERR;
}

int NetcdfFile::id_of(const std::string& variable) const
{
    int id = 0;
    if (const int status = nc_inq_varid(id_, variable.c_str(), &id); status != NC_NOERR)
        fail(variable, fmt::format("is missing ({})", nc_strerror(status)));
    return id;
}

NetcdfFile::Shape NetcdfFile::find_shape(const std::string& variable) const
{
    const int id = id_of(variable);
    int count = 0;
    int dimensions[NC_MAX_VAR_DIMS];
    if (nc_inq_varndims(id_, id, &count) != NC_NOERR || nc_inq_vardimid(id_, id, dimensions) != NC_NOERR)
        fail(variable, "has no readable shape");
    Shape shape;
    for (int d = 0; d < count; ++d)
    {
        char name[NC_MAX_NAME + 1] = "";
        std::size_t length = 0;
        if (nc_inq_dim(id_, dimensions[d], name, &length) != NC_NOERR)
            fail(variable, "has no readable shape");
        if (d == 0 && std::string_view(name) == "t" && count > 1)
        {
            if (length == 0) fail(variable, "holds no time slice");
            shape.slices = length;
            continue;
        }
        shape.lengths.push_back(length);
    }
    return shape;
}

std::vector<std::size_t> NetcdfFile::shape(const std::string& variable) const
{
    return find_shape(variable).lengths;
}

std::size_t NetcdfFile::slices(const std::string& variable) const
{
    return std::max<std::size_t>(find_shape(variable).slices, 1);
}

std::vector<float> NetcdfFile::read(const std::string& variable, const std::vector<std::size_t>& expected,
                                    std::size_t slice) const
{
    const Shape shape = find_shape(variable);
    if (shape.lengths != expected)
        fail(variable, fmt::format("has {} numbers, not {} as the other variables need",
                                   fmt::join(shape.lengths, " x "), fmt::join(expected, " x ")));
    std::vector<std::size_t> start(shape.lengths.size(), 0), count = shape.lengths;
    if (shape.slices > 0)
    {
        start.insert(start.begin(), slice);
        count.insert(count.begin(), 1);
    }
    std::size_t total = 1;
    for (const std::size_t n : shape.lengths) total *= n;
    std::vector<float> values(total);
    const int status = nc_get_vara_float(id_, id_of(variable), start.data(), count.data(), values.data());
    if (status != NC_NOERR && status != NC_ERANGE)
        fail(variable, fmt::format("cannot be read ({}); the file may be cut off", nc_strerror(status)));
    for (std::size_t i = 0; i < total; ++i)
        if (!(std::abs(values[i]) < 1e6F))
            fail(variable, fmt::format("holds {} as number {}, which is not sound", values[i], i));
    return values;
}

std::vector<double> NetcdfFile::read_times(const std::string& variable, std::size_t count) const
{
    if (const auto lengths = shape(variable); lengths != std::vector{count})
        fail(variable, fmt::format("has {} numbers, not one for each of {} time slices",
                                   fmt::join(lengths, " x "), count));
    std::vector<double> times(count);
    if (const int status = nc_get_var_double(id_, id_of(variable), times.data()); status != NC_NOERR)
        fail(variable, fmt::format("cannot be read ({}); the file may be cut off", nc_strerror(status)));
    for (std::size_t i = 0; i < count; ++i)
        if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1])))
            fail(variable, fmt::format("has {} as time {}; times must be finite and rise", times[i], i));
    return times;
}

}  // namespace spindrift::scene
