// SPDX-License-Identifier: MIT
#pragma once

#include "core/staggered_wind.h"
#include "core/view.h"
#include "core/world.h"
#include "scene/flow_field.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "scene/solve_wind.h"

namespace spindrift::scene
{

/// A wind on a grid: its faces, and cell means with turbulence.
struct GriddedWind
{
    SolvedWind solved;
    FlowField flow;
};

/// Everything that flakes meet, from a validated scene: local frame, voxels of the solid geometry and of the
/// wind file's solid cells, wind records. A gridded wind is made divergence-free by `project_wind`. Throws
/// Error for wind files that are missing, truncated or do not fit the domain.
/// `kept`, if given, takes the wind as it is on its grid; it stays empty if the wind is a formula.
World make_world(const Scene& scene, const Geometry& geometry, const WindProjector& project_wind,
                 GriddedWind* kept = nullptr);

/// The camera of a scene at a time, in the local frame.
View camera_at(const Scene& scene, double time_s);

/// Position of a vehicle at a time, in the local frame.
Vec3f vehicle_at(const VehicleSettings& vehicle, const DomainSettings& domain, double time_s);

}  // namespace spindrift::scene
