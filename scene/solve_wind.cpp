// SPDX-License-Identifier: MIT
#include "scene/solve_wind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scene/project_wind.h"
#include "scene/wind_cache.h"

namespace spindrift::scene
{

namespace
{

/// From the floor to the top of the domain, each layer `growth` times as thick as the one below it; scaled
/// so that a whole number of them fits.
std::vector<double> layers_of(double extent_m, double lowest_m, double growth)
{
    std::vector<double> layers;
    double total = 0;
    for (double layer = lowest_m; total < extent_m * (1 - 1e-6); layer *= growth)
    {
        layers.push_back(layer);
        total += layer;
    }
    for (double& layer : layers) layer *= extent_m / total;
    return layers;
}

StaggeredWind empty_grid(const WindSettings& settings, const Surroundings& around)
{
    const double extent = around.size_m.z - around.floor_m;
    if (!(extent > 0))
        throw Error(fmt::format(
            "the ground is {:g} m above the bottom of a domain that is {:g} m high: no room for wind; raise "
            "domain.max_m",
            around.floor_m, around.size_m.z));
    const auto cells = [&](double length)
    { return std::max(1, static_cast<int>(std::ceil(length / settings.cell_m - 1e-6))); };
    const double lowest = settings.layer_m > 0 ? settings.layer_m : settings.cell_m;
    std::vector<double> layers = layers_of(extent, lowest, settings.layer_growth);
    const GridSize n{cells(around.size_m.x), cells(around.size_m.y), static_cast<int>(layers.size())};
    const Vec3d cell{around.size_m.x / n.nx, around.size_m.y / n.ny, layers.front()};
    return {n, cell, std::move(layers)};
}

/// So that what is kept in single precision is what flakes meet.
void round_to_float(StaggeredWind& wind)
{
    for (auto* faces : {&wind.u, &wind.v, &wind.w})
        for (double& v : *faces) v = static_cast<double>(static_cast<float>(v));
}

/// Middle heights of layers.
std::vector<double> middles(const std::vector<double>& layers)
{
    std::vector<double> result;
    double low = 0;
    for (const double layer : layers)
    {
        result.push_back(low + 0.5 * layer);
        low += layer;
    }
    return result;
}

/// Value at `height` between entries at ascending heights, held beyond them.
template <class At>
double between(const std::vector<double>& heights, double height, const At& at)
{
    const auto above = std::upper_bound(heights.begin(), heights.end(), height) - heights.begin();
    if (above == 0) return at(0);
    if (above == std::ssize(heights)) return at(heights.size() - 1);
    const auto high = static_cast<std::size_t>(above);
    const double share = (height - heights[high - 1]) / (heights[high] - heights[high - 1]);
    return at(high - 1) + share * (at(high) - at(high - 1));
}

/// The layer of the old grid that holds a height.
std::size_t layer_at(const std::vector<double>& layers, double height)
{
    double top = 0;
    for (std::size_t k = 0; k < layers.size(); ++k)
        if (top += layers[k]; height < top) return k;
    return layers.size() - 1;
}

void make_even(StaggeredWind& wind, std::vector<WindZone>& zone)
{
    double extent = 0;
    for (const double layer : wind.layer_m) extent += layer;
    const int nz = std::max(1, static_cast<int>(std::ceil(extent / wind.cell_m.z - 1e-6)));
    StaggeredWind even({wind.size.nx, wind.size.ny, nz}, {wind.cell_m.x, wind.cell_m.y, extent / nz});
    const std::vector<double> centres = middles(wind.layer_m);
    std::vector<double> faces{0};
    for (const double layer : wind.layer_m) faces.push_back(faces.back() + layer);
    std::vector<WindZone> even_zone(even.size.count());
    const auto fill = [&](std::vector<double>& to, const std::vector<double>& from, GridSize n, bool at_faces)
    {
        const std::size_t plane = static_cast<std::size_t>(n.nx) * static_cast<std::size_t>(n.ny);
        for (int k = 0; k < n.nz; ++k)
            for (std::size_t i = 0; i < plane; ++i)
                to[static_cast<std::size_t>(k) * plane + i] =
                    between(at_faces ? faces : centres, (k + (at_faces ? 0 : 0.5)) * even.cell_m.z,
                            [&](std::size_t layer) { return from[layer * plane + i]; });
    };
    fill(even.u, wind.u, even.u_size(), false);
    fill(even.v, wind.v, even.v_size(), false);
    fill(even.w, wind.w, even.w_size(), true);
    const std::size_t plane = static_cast<std::size_t>(even.size.nx) * static_cast<std::size_t>(even.size.ny);
    for (int k = 0; k < nz; ++k)
    {
        const std::size_t from = layer_at(wind.layer_m, (k + 0.5) * even.cell_m.z) * plane,
                          to = static_cast<std::size_t>(k) * plane;
        for (std::size_t i = 0; i < plane; ++i)
        {
            even.solid[to + i] = wind.solid[from + i];
            even_zone[to + i] = zone[from + i];
        }
    }
    wind = std::move(even);
    zone = std::move(even_zone);
}

bool in_a_box(const Surroundings& around, double x, double y)
{
    for (const Footprint& box : around.boxes)
    {
        const Vec3d &low = box.outlines[0][0], &high = box.outlines[0][2];
        if (x >= low.x && x < high.x && y >= low.y && y < high.y) return true;
    }
    return false;
}

}  // namespace

std::vector<Footprint> footprints_of_voxels(const StaggeredWind& wind, Vec3d low_m,
                                            const Surroundings& around)
{
    const GridSize n = wind.size;
    const std::size_t plane = static_cast<std::size_t>(n.nx) * static_cast<std::size_t>(n.ny);
    const Vec3d cell = wind.cell_m;
    std::vector<double> top(plane, -INFINITY);  // of what stands on a column
    double height = low_m.z;
    for (int z = 0; z < n.nz; height += wind.layer_m[z], ++z)
        for (std::size_t i = 0; i < plane; ++i)
        {
            if (wind.solid[static_cast<std::size_t>(z) * plane + i] == 0) continue;
            const double x = low_m.x +
                             (static_cast<double>(i % static_cast<std::size_t>(n.nx)) + 0.5) * cell.x,
                         y = low_m.y +
                             (static_cast<double>(i / static_cast<std::size_t>(n.nx)) + 0.5) * cell.y;
            if (height + 0.5 * wind.layer_m[z] <= around.ground_m(x, y) + wind.layer_m[z]) continue;
            if (!in_a_box(around, x, y)) top[i] = height + wind.layer_m[z];
        }
    std::vector<Footprint> found;
    std::vector<std::size_t> stack;
    for (std::size_t seed = 0; seed < plane; ++seed)
    {
        if (!(top[seed] > -INFINITY)) continue;
        Footprint block;
        block.top_m = -INFINITY, block.ground_m = INFINITY;
        const auto enter = [&](std::size_t i)
        {
            if (!(top[i] > -INFINITY)) return;
            const double x = low_m.x + static_cast<double>(i % static_cast<std::size_t>(n.nx)) * cell.x,
                         y = low_m.y + static_cast<double>(i / static_cast<std::size_t>(n.nx)) * cell.y;
            block.outlines.push_back(
                {{x, y, 0}, {x + cell.x, y, 0}, {x + cell.x, y + cell.y, 0}, {x, y + cell.y, 0}});
            block.top_m = std::max(block.top_m, top[i]);
            block.ground_m = std::min(block.ground_m, around.ground_m(x + 0.5 * cell.x, y + 0.5 * cell.y));
            top[i] = -INFINITY;
            stack.push_back(i);
        };
        enter(seed);
        while (!stack.empty())
        {
            const std::size_t i = stack.back(), x = i % static_cast<std::size_t>(n.nx);
            stack.pop_back();
            if (x > 0) enter(i - 1);
            if (x + 1 < static_cast<std::size_t>(n.nx)) enter(i + 1);
            if (i >= static_cast<std::size_t>(n.nx)) enter(i - static_cast<std::size_t>(n.nx));
            if (i + static_cast<std::size_t>(n.nx) < plane) enter(i + static_cast<std::size_t>(n.nx));
        }
        block.base_m = block.ground_m;
        found.push_back(std::move(block));
    }
    return found;
}

SolvedWind solve_wind(const WindSettings& settings, const Surroundings& around, const WindProjector& project,
                      const std::filesystem::path& cache_folder)
{
    SolvedWind solved;
    StaggeredWind& wind = solved.wind;
    wind = empty_grid(settings, around);
    solved.low_m = {0, 0, around.floor_m};
    if (around.voxels != nullptr && around.voxels->nx > 0) mark_solids(wind, solved.low_m, *around.voxels);
    std::vector<Footprint> footprints;
    if (settings.zones)
    {
        footprints = footprints_of_voxels(wind, solved.low_m, around);
        footprints.insert(footprints.end(), around.boxes.begin(), around.boxes.end());
    }
    solved.blocks = footprints.size();
    solved.zone = fill_zones(wind, solved.low_m, InflowProfile(settings), around.ground_m, footprints);
    if (!cache_folder.empty())
    {
        solved.cached = cache_folder / (wind_key(wind) + ".nc");
        solved.from_cache = read_cached(solved.cached, wind);
    }
    if (!solved.from_cache)
    {
        solved.projection = project(wind);
        round_to_float(wind);
        if (!cache_folder.empty()) write_cached(solved.cached, wind);
    }
    if (settings.layer_growth > 1)
    {
        make_even(wind, solved.zone);
        project(wind);
    }
    return solved;
}

}  // namespace spindrift::scene
