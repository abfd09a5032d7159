// SPDX-License-Identifier: MIT
#pragma once

#include "core/staggered_wind.h"
#include "scene/flow_field.h"

namespace spindrift::scene
{

/// The neutral logarithmic wind of World::wind (its friction velocity, roughness and direction) on cells of
/// about `cell_m` from its ground to the top of the domain, closed at the solid cells (half or more of a
/// cell's voxels) and made divergence-free by `project`. The field is the least change of the approaching
/// wind: it flows round and over blocks, but has no wakes of its own. Throws Error if the ground is not below
/// the top of the domain.
StaggeredWind wind_around_solids(const Wind& profile, Vec3f size_m, double cell_m, const VoxelGrid& voxels,
                                 const WindProjector& project);

/// Marks the cells of `wind` of whose voxels half or more are solid; `low_m`: its lower corner.
void mark_solids(StaggeredWind& wind, Vec3d low_m, const VoxelGrid& voxels);

/// Cell means of a staggered wind; no turbulence yet.
FlowField cell_means(const StaggeredWind& wind, Vec3d low_m);

}  // namespace spindrift::scene
