// SPDX-License-Identifier: MIT
#include "scene/project_wind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace spindrift::scene
{

namespace
{

/// Solid voxels among those whose centres lie in [low, high); at least the one at the middle is looked at.
bool mostly_solid(const VoxelGrid& voxels, const Vec3d& low, const Vec3d& high)
{
    struct Span
    {
        int from, to;
    };
    const auto span = [&](double a, double b, float origin, int n) -> Span
    {
        const double cell = voxels.cell_m;
        const auto index = [&](double v) { return static_cast<int>(std::clamp(v, -1.0, n + 1.0)); };
        const int from = index(std::ceil((a - origin) / cell - 0.5)),
                  to = index(std::ceil((b - origin) / cell - 0.5));
        if (from < to) return {from, to};
        const int middle = index(std::floor((0.5 * (a + b) - origin) / cell));
        return {middle, middle + 1};
    };
    const Span x = span(low.x, high.x, voxels.origin_m.x, voxels.nx),
               y = span(low.y, high.y, voxels.origin_m.y, voxels.ny),
               z = span(low.z, high.z, voxels.origin_m.z, voxels.nz);
    const GridSize size{voxels.nx, voxels.ny, voxels.nz};
    long solid = 0, all = 0;
    for (int k = z.from; k < z.to; ++k)
        for (int j = y.from; j < y.to; ++j)
            for (int i = x.from; i < x.to; ++i)
            {
                ++all;
                const bool inside =
                    i >= 0 && j >= 0 && k >= 0 && i < voxels.nx && j < voxels.ny && k < voxels.nz;
                if (inside && voxels.clearance[size.index(i, j, k)] == 0) ++solid;
            }
    return 2 * solid >= all;
}

}  // namespace

StaggeredWind wind_around_solids(const Wind& profile, Vec3f size_m, double cell_m, const VoxelGrid& voxels,
                                 const WindProjector& project)
{
    const double ground = profile.ground_m;
    const Vec3d extent{size_m.x, size_m.y, size_m.z - ground};
    if (!(extent.z > 0))
        throw Error(fmt::format(
            "the ground is {:g} m above the bottom of a domain that is {:g} m high: no room for wind; raise "
            "domain.max_m",
            ground, static_cast<double>(size_m.z)));
    const auto cells = [&](double length)
    { return std::max(1, static_cast<int>(std::ceil(length / cell_m - 1e-6))); };
    const GridSize n{cells(extent.x), cells(extent.y), cells(extent.z)};
    StaggeredWind wind(n, {extent.x / n.nx, extent.y / n.ny, extent.z / n.nz});
    std::vector<double> speed(static_cast<std::size_t>(n.nz));
    const double z0 = profile.roughness_m;
    for (int k = 0; k < n.nz; ++k)
        speed[k] =
            profile.friction_velocity_m_s / kVonKarman * std::log(((k + 0.5) * wind.cell_m.z + z0) / z0);
    for (int k = 0; k < n.nz; ++k)
    {
        const std::size_t u_layer = wind.u.size() / static_cast<std::size_t>(n.nz),
                          v_layer = wind.v.size() / static_cast<std::size_t>(n.nz);
        std::fill_n(wind.u.begin() + static_cast<std::ptrdiff_t>(u_layer) * k, u_layer,
                    speed[k] * profile.to_x);
        std::fill_n(wind.v.begin() + static_cast<std::ptrdiff_t>(v_layer) * k, v_layer,
                    speed[k] * profile.to_y);
    }
    if (voxels.nx > 0) mark_solids(wind, {0, 0, ground}, voxels);
    project(wind);
    return wind;
}

void mark_solids(StaggeredWind& wind, Vec3d low_m, const VoxelGrid& voxels)
{
    double bottom = low_m.z;
    for (int z = 0; z < wind.size.nz; ++z)
    {
        const double top = bottom + wind.layer_m[z];
        for (int y = 0; y < wind.size.ny; ++y)
            for (int x = 0; x < wind.size.nx; ++x)
            {
                const double west = low_m.x + x * wind.cell_m.x, south = low_m.y + y * wind.cell_m.y;
                if (mostly_solid(voxels, {west, south, bottom},
                                 {west + wind.cell_m.x, south + wind.cell_m.y, top}))
                    wind.solid[wind.size.index(x, y, z)] = 1;
            }
        bottom = top;
    }
}

FlowField cell_means(const StaggeredWind& wind, Vec3d low_m)
{
    FlowField flow;
    flow.size = wind.size;
    flow.low_m = low_m;
    flow.cell_m = wind.cell_m;
    flow.solid = wind.solid;
    flow.mean.resize(wind.size.count());
    for (int z = 0; z < wind.size.nz; ++z)
        for (int y = 0; y < wind.size.ny; ++y)
            for (int x = 0; x < wind.size.nx; ++x)
                if (const std::size_t i = wind.size.index(x, y, z); wind.solid[i] == 0)
                    flow.mean[i] = wind.centre(x, y, z);
    return flow;
}

}  // namespace spindrift::scene
