// SPDX-License-Identifier: MIT
#pragma once

#include "core/staggered_wind.h"
#include "core/view.h"
#include "core/world.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::scene
{

/// Everything that flakes meet, from a validated scene: local frame, voxels of the solid geometry and of the
/// wind file's solid cells, wind records. A gridded wind is made divergence-free by `project_wind`. Throws
/// Error for wind files that are missing, truncated or do not fit the domain.
World make_world(const Scene& scene, const Geometry& geometry, const WindProjector& project_wind);

/// The camera of a scene at a time, in the local frame.
View camera_at(const Scene& scene, double time_s);

/// Position of a vehicle at a time, in the local frame.
Vec3f vehicle_at(const VehicleSettings& vehicle, const DomainSettings& domain, double time_s);

}  // namespace spindrift::scene
