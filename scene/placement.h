// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/vec.h"
#include "scene/scene.h"

namespace spindrift::scene
{

/// How the points of a model file come into the frame of a scene (or of the vehicle that carries it): up
/// axis, scale, yaw, position.
class Placement
{
  public:
    explicit Placement(const ModelSettings& settings) : settings_(settings)
    {
        // a vehicle's heading and the wind's aside, yaw is mathematical: counter-clockwise seen from above
        const double yaw = settings.yaw_deg * (3.14159265358979323846 / 180.0);
        cos_ = std::cos(yaw);
        sin_ = std::sin(yaw);
    }

    /// Directions and normals: up axis and yaw only.
    Vec3d direction(const Vec3d& v) const
    {
        const Vec3d up = settings_.y_up ? Vec3d{v.x, -v.z, v.y} : v;
        return {cos_ * up.x - sin_ * up.y, sin_ * up.x + cos_ * up.y, up.z};
    }

    Vec3d point(const Vec3d& p) const { return direction(p) * settings_.scale + settings_.position_m; }

  private:
    const ModelSettings& settings_;
    double cos_ = 1, sin_ = 0;
};

}  // namespace spindrift::scene
