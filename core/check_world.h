// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/error.h"
#include "core/math.h"
#include "core/number.h"
#include "core/world.h"

namespace spindrift
{

namespace detail
{

inline std::string extents(int nx, int ny, int nz)
{
    return std::to_string(nx) + " x " + std::to_string(ny) + " x " + std::to_string(nz);
}

inline std::size_t cells_of(int nx, int ny, int nz, const char* grid)
{
    const auto n = [](int i) { return static_cast<double>(i); };
    if (nx < 1 || ny < 1 || nz < 1 || n(nx) * n(ny) * n(nz) > 2147483647.0)
        throw Error(std::string(grid) + " has " + extents(nx, ny, nz) +
                    " cells; use at least 1 along each axis and fewer than 2^31 in all");
    return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz);
}

inline void check_wind(const Wind& wind)
{
    if (wind.kind != WindKind::grid) return;
    if (cells_of(wind.nx, wind.ny, wind.nz, "the wind grid") != wind.cells.size())
        throw Error("the wind grid of " + extents(wind.nx, wind.ny, wind.nz) + " cells holds " +
                    std::to_string(wind.cells.size()) + " of them");
    if (!(wind.cell_m.x > 0 && wind.cell_m.y > 0 && wind.cell_m.z > 0))
        throw Error("the wind grid has cells without size; they need more than 0 m along each axis");
}

inline void check_voxels(const World& world)
{
    const VoxelGrid& v = world.voxels;
    if (v.nx == 0) return;
    const std::size_t cells = cells_of(v.nx, v.ny, v.nz, "the voxel grid");
    if (v.clearance.size() != cells || v.surface.size() != cells)
        throw Error("the voxel grid of " + std::to_string(cells) + " cells has " +
                    std::to_string(v.clearance.size()) + " clearances and " +
                    std::to_string(v.surface.size()) + " surfaces");
    for (std::size_t i = 0; i < cells; ++i)
        if (v.clearance[i] == 0 && v.surface[i] >= world.surfaces.size())
            throw Error("voxel " + std::to_string(i) + " names surface " + std::to_string(v.surface[i]) +
                        " of " + std::to_string(world.surfaces.size()));
}

}  // namespace detail

/// Throws Error for a World whose parts contradict each other, so that no kernel reads outside an array. Host
/// only.
inline void check_world(const World& world)
{
    if (world.emitters.size() > 255)
        throw Error(std::to_string(world.emitters.size()) +
                    " emitters (their number is kept in a byte); use at most 255");
    if (world.capacity >= std::uint64_t{1} << 32)
        throw Error("capacity of " + std::to_string(world.capacity) +
                    " flakes (slots are counted in 32 bits); use fewer than 2^32");
    if (!(world.step_s > 0) || !is_finite(world.step_s))
        throw Error("step of " + std::to_string(world.step_s) + " s; use more than 0");
    for (std::size_t i = 1; i < world.emitters.size(); ++i)
        if (world.emitters[i - 1].shape == EmitterShape::drift &&
            world.emitters[i].shape != EmitterShape::drift)
            throw Error("emitter " + std::to_string(i + 1) +
                        " comes after a drift (a flake is known for a grain by its emitter's number); put "
                        "drifts last");
    for (const Emitter& e : world.emitters)
        if (e.anchor >= 0 && (static_cast<std::size_t>(e.anchor) >= world.anchors.size() ||
                              world.anchors[static_cast<std::size_t>(e.anchor)].keys.empty()))
            throw Error("an emitter follows anchor " + std::to_string(e.anchor) +
                        ", which does not exist or has no keys");
    detail::check_wind(world.wind);
    detail::check_voxels(world);
}

}  // namespace spindrift
