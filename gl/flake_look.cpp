// SPDX-License-Identifier: MIT
#include "gl/flake_look.h"

#include <GL/glew.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/snow.h"

namespace spindrift::gl
{

SpriteLimits sprite_limits(const View& view)
{
    // Software GL's points end at 255 px across.
    constexpr float kLargest = 127.0F;
    constexpr float kSmallest = 0.75F;
    std::array<GLfloat, 2> range{1, 1};
    glGetFloatv(GL_POINT_SIZE_RANGE, range.data());
    return {kSmallest, std::min({std::round(view.guard_px), kLargest, 0.5F * range[1]})};
}

float mean_melted_mm(const Snow& snow)
{
    return static_cast<float>(1.0 / size_law(snow.spectrum, static_cast<double>(snow.rate_mm_h)).slope);
}

}  // namespace spindrift::gl
