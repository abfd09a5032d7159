// SPDX-License-Identifier: MIT
#include "scene/wind_cache.h"

#include <fmt/format.h>
#include <netcdf.h>

#include "core/error.h"
#include "core/philox.h"
#include "scene/netcdf_file.h"
#include "scene/netcdf_writer.h"
#include "scene/try_in_child.h"

namespace spindrift::scene
{

namespace
{

/// Changes when a projection of the same faces would come out otherwise.
constexpr std::uint64_t kVersion = 1;

constexpr unsigned kLongestRead_s = 300;

std::vector<float> narrow(const std::vector<double>& values)
{
    return {values.begin(), values.end()};
}

std::vector<std::size_t> shape_of(GridSize n)
{
    return {static_cast<std::size_t>(n.nz), static_cast<std::size_t>(n.ny), static_cast<std::size_t>(n.nx)};
}

}  // namespace

std::string wind_key(const StaggeredWind& wind)
{
    std::uint64_t one = mix64(kVersion + 0x9E3779B97F4A7C15U), other = mix64(one);
    const auto add = [&](std::uint64_t word)
    {
        one = mix64(one ^ word);
        other = mix64((other << 7 | other >> 57) + word * 0x9E3779B97F4A7C15U);
    };
    const auto add_number = [&](double v) { add(__builtin_bit_cast(std::uint64_t, v)); };
    for (const int n : {wind.size.nx, wind.size.ny, wind.size.nz}) add(static_cast<std::uint64_t>(n));
    add_number(wind.cell_m.x), add_number(wind.cell_m.y);
    for (const auto* numbers : {&wind.layer_m, &wind.u, &wind.v, &wind.w})
        for (const double v : *numbers) add_number(v);
    for (const std::uint8_t solid : wind.solid) add(solid);
    return fmt::format("wind-{:016x}{:016x}", one, other);
}

bool read_cached(const std::filesystem::path& file, StaggeredWind& wind)
{
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return false;
    const auto read = [&]
    {
        const NetcdfFile kept(file);
        const auto take = [&](const char* name, GridSize n, std::vector<double>& to)
        {
            const std::vector<float> values = kept.read(name, shape_of(n));
            to.assign(values.begin(), values.end());
        };
        take("u", wind.u_size(), wind.u);
        take("v", wind.v_size(), wind.v);
        take("w", wind.w_size(), wind.w);
    };
    // a broken file may take the NetCDF library down
    const bool sound = try_in_child(read, kLongestRead_s) == ChildFate::returned;
    try
    {
        if (!sound) throw Error(fmt::format("{} is broken", file.string()));
        read();
    }
    catch (const Error& error)
    {
        throw Error(fmt::format("{}; delete it and the wind is computed again", error.what()));
    }
    return true;
}

void write_cached(const std::filesystem::path& file, const StaggeredWind& wind)
{
    NetcdfWriter out(file);
    const std::pair<std::string, int> lengths[] = {
        {"x", wind.size.nx},          {"y", wind.size.ny},          {"z", wind.size.nz},
        {"x_face", wind.size.nx + 1}, {"y_face", wind.size.ny + 1}, {"z_face", wind.size.nz + 1}};
    for (const auto& [name, length] : lengths) out.dimension(name, static_cast<std::size_t>(length));
    out.variable("u", NC_FLOAT, {"z", "y", "x_face"}, {{"units", "m s-1"}});
    out.variable("v", NC_FLOAT, {"z", "y_face", "x"}, {{"units", "m s-1"}});
    out.variable("w", NC_FLOAT, {"z_face", "y", "x"}, {{"units", "m s-1"}});
    out.attribute("title", "face velocities of a projected wind, kept by spindrift; may be deleted");
    out.end_definitions();
    out.put("u", narrow(wind.u));
    out.put("v", narrow(wind.v));
    out.put("w", narrow(wind.w));
    out.close();
}

}  // namespace spindrift::scene
