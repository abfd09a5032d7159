// SPDX-License-Identifier: MIT
#pragma once

#include "core/vec.h"

namespace spindrift
{

/// A pinhole camera in the local frame (m), as culling, depth keys, drawing and the reference renderer see
/// it.
struct View
{
    Vec3f eye{};
    Vec3f right{1, 0, 0};  ///< orthonormal with up and forward
    Vec3f up{0, 0, 1};
    Vec3f forward{0, 1, 0};
    float tan_half_fov_y = 0.5F;
    int width_px = 1280;
    int height_px = 720;
    float near_m = 0.1F;
    float far_m = 1000.0F;
    /// Flakes whose centre is this many pixels outside the picture are still drawn, so that large sprites do
    /// not pop.
    float guard_px = 128.0F;
};

}  // namespace spindrift
