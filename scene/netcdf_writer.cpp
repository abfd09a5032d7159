// SPDX-License-Identifier: MIT
#include "scene/netcdf_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netcdf.h>
#include <unistd.h>

#include <utility>

#include "core/error.h"

namespace spindrift::scene
{

NetcdfWriter::NetcdfWriter(std::filesystem::path file) : file_(std::move(file)), aside_(file_)
{
    aside_ += fmt::format(".{}.part", getpid());
    std::error_code failed;
    if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path(), failed);
    const int status = nc_create(aside_.c_str(), NC_NETCDF4 | NC_CLOBBER, &id_);
    if (status != NC_NOERR) id_ = -1;
    check(status, "be written");
}

NetcdfWriter::~NetcdfWriter()
{
    if (id_ < 0) return;
    nc_abort(id_);
    std::error_code ignored;
    std::filesystem::remove(aside_, ignored);
}

void NetcdfWriter::check(int status, const std::string& what) const
{
    if (status != NC_NOERR)
        throw Error(fmt::format("{} cannot {} ({}); is the folder there, writable and not full?",
                                file_.string(), what, nc_strerror(status)));
}

void NetcdfWriter::dimension(const std::string& name, std::size_t length)
{
    int id = 0;
    check(nc_def_dim(id_, name.c_str(), length == 0 ? NC_UNLIMITED : length, &id), "take dimension " + name);
}

void NetcdfWriter::variable(const std::string& name, int type, const std::vector<std::string>& dimensions,
                            const std::vector<std::pair<std::string, std::string>>& attributes)
{
    std::vector<int> ids(dimensions.size());
    for (std::size_t d = 0; d < dimensions.size(); ++d)
        check(nc_inq_dimid(id_, dimensions[d].c_str(), &ids[d]), "take variable " + name);
    int id = 0;
    check(nc_def_var(id_, name.c_str(), type, static_cast<int>(ids.size()), ids.data(), &id),
          "take variable " + name);
    for (const auto& [key, text] : attributes)
        check(nc_put_att_text(id_, id, key.c_str(), text.size(), text.c_str()), "take attribute " + key);
}

void NetcdfWriter::attribute(const std::string& name, const std::string& text)
{
    check(nc_put_att_text(id_, NC_GLOBAL, name.c_str(), text.size(), text.c_str()), "take attribute " + name);
}

void NetcdfWriter::end_definitions()
{
    check(nc_enddef(id_), "be written");
}

template <class T, class Put>
void NetcdfWriter::put_slice(const std::string& name, const T* values, std::size_t count, Put put)
{
    int id = 0, rank = 0, unlimited = -1;
    int dimensions[NC_MAX_VAR_DIMS];
    check(nc_inq_varid(id_, name.c_str(), &id), "hold " + name);
    check(nc_inq_varndims(id_, id, &rank), "hold " + name);
    check(nc_inq_vardimid(id_, id, dimensions), "hold " + name);
    check(nc_inq_unlimdim(id_, &unlimited), "hold " + name);
    std::vector<std::size_t> start(static_cast<std::size_t>(rank), 0), lengths(start);
    std::size_t total = 1;
    for (std::size_t d = 0; d < lengths.size(); ++d)
    {
        check(nc_inq_dimlen(id_, dimensions[d], &lengths[d]), "hold " + name);
        if (dimensions[d] == unlimited) lengths[d] = 1;
        total *= lengths[d];
    }
    if (total != count)
        throw Error(
            fmt::format("{}: {} numbers for '{}', which holds {}", file_.string(), count, name, total));
    check(put(id, start.data(), lengths.data(), values), "hold " + name);
}

void NetcdfWriter::put(const std::string& name, const std::vector<float>& values)
{
    put_slice(name, values.data(), values.size(),
              [&](int id, const std::size_t* start, const std::size_t* count, const float* v)
              { return nc_put_vara_float(id_, id, start, count, v); });
}

void NetcdfWriter::put(const std::string& name, const std::vector<double>& values)
{
    put_slice(name, values.data(), values.size(),
              [&](int id, const std::size_t* start, const std::size_t* count, const double* v)
              { return nc_put_vara_double(id_, id, start, count, v); });
}

void NetcdfWriter::put(const std::string& name, const std::vector<int>& values)
{
    put_slice(name, values.data(), values.size(),
              [&](int id, const std::size_t* start, const std::size_t* count, const int* v)
              { return nc_put_vara_int(id_, id, start, count, v); });
}

void NetcdfWriter::put(const std::string& name, const std::string& text)
{
    put_slice(name, text.data(), text.size(),
              [&](int id, const std::size_t* start, const std::size_t* count, const char* v)
              { return nc_put_vara_text(id_, id, start, count, v); });
}

void NetcdfWriter::close()
{
    const int status = nc_close(id_);
    id_ = -1;
    std::error_code failed;
    if (status != NC_NOERR) std::filesystem::remove(aside_, failed);
    check(status, "be closed");
    if (const int descriptor = open(aside_.c_str(), O_RDONLY); descriptor >= 0)
    {
        fsync(descriptor);
        ::close(descriptor);
    }
    std::filesystem::rename(aside_, file_, failed);
    if (failed)
    {
        std::error_code ignored;
        std::filesystem::remove(aside_, ignored);
        throw Error(fmt::format("{} cannot be put in place ({})", file_.string(), failed.message()));
    }
}

}  // namespace spindrift::scene
