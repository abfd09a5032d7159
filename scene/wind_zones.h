// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/staggered_wind.h"
#include "scene/inflow_profile.h"
#include "scene/wind_blocks.h"

namespace spindrift::scene
{

/// Kinds of cells, numbered as in the icellflag of QES-Winds.
enum class WindZone : std::uint8_t
{
    building = 0,
    fluid = 1,
    terrain = 2,
    upwind = 3,
    cavity = 4,
    wake = 5,
    canyon = 6,
    separated = 7,  ///< over roofs and along side walls; written as fluid
};

/// Height of the ground (local frame, m) at x and y.
using GroundHeight = std::function<double(double, double)>;

/// Fills the faces of `wind` (whose solid cells are known) with the approaching wind over the ground and with
/// the zones round the footprints; `low_m`: its lower corner, local frame. Returns the kind of every cell.
/// Nothing is conserved yet: a projection has to follow. docs/physics.md "Zones".
std::vector<WindZone> fill_zones(StaggeredWind& wind, Vec3d low_m, const InflowProfile& profile,
                                 const GroundHeight& ground_m, const std::vector<Footprint>& footprints);

}  // namespace spindrift::scene
