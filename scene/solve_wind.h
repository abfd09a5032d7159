// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "core/staggered_wind.h"
#include "scene/scene.h"
#include "scene/wind_zones.h"

namespace spindrift::scene
{

/// What the wind meets, local frame.
struct Surroundings
{
    Vec3d size_m{1, 1, 1};  ///< of the domain
    double floor_m = 0;     ///< lowest ground; the wind's cells begin there
    GroundHeight ground_m;  ///< height of the ground, nowhere below floor_m
    std::vector<Footprint> boxes;
    const VoxelGrid* voxels = nullptr;  ///< everything solid, boxes too
};

/// A wind that was computed here.
struct SolvedWind
{
    StaggeredWind wind;  ///< free of divergence; the layers are even
    Vec3d low_m{};       ///< lower corner of its first cell
    std::vector<WindZone> zone;
    Projection projection;
    std::size_t blocks = 0;
    std::filesystem::path cached;  ///< the file that it was read from or kept in; may be empty
    bool from_cache = false;
};

/// Approaching wind, zones, projection; then, if the layers are not even, even layers of the thinnest one's
/// thickness, projected again. Numbers are rounded to float. With a cache folder the result is kept there
/// under a hash of everything that the projection depends on. Throws Error if the ground is not below the top
/// of the domain, or the cache cannot be read or written.
SolvedWind solve_wind(const WindSettings& settings, const Surroundings& around, const WindProjector& project,
                      const std::filesystem::path& cache_folder);

/// Blocks among the solid voxels that are not part of a box: what touches as seen from above is one block.
std::vector<Footprint> footprints_of_voxels(const StaggeredWind& wind, Vec3d low_m,
                                            const Surroundings& around);

}  // namespace spindrift::scene
