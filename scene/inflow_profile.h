// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/vec.h"
#include "scene/scene.h"

namespace spindrift::scene
{

/// The undisturbed wind over height above the ground: logarithmic, a power law, or measured levels.
class InflowProfile
{
  public:
    explicit InflowProfile(const WindSettings& settings);

    /// Mean velocity at a height (m) above the ground; 0 at and below it. The vertical part is 0.
    Vec3d at(double height_m) const;

    /// That of the logarithmic law through speed and height which the settings give (measured: the lowest
    /// level).
    double friction_velocity_m_s() const { return friction_m_s_; }

  private:
    double logarithm(double height_m) const;  ///< ln((z + z0) / z0)
    Vec3d measured(double height_m) const;

    const WindSettings& settings_;
    double friction_m_s_ = 0;
    Vec3d to_{1, 0, 0};
    std::vector<Vec3d> levels_;  ///< velocities of the measured ones
};

}  // namespace spindrift::scene
