// SPDX-License-Identifier: MIT
#include "gl/flake_look.h"

#include <GL/glew.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/philox.h"

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
    const bool gunn = snow.spectrum == SizeSpectrum::gunn_marshall;
    return static_cast<float>(gunn ? std::pow(snow.rate_mm_h, 0.48) / 2.55
                                   : std::pow(snow.rate_mm_h, 0.45) / 2.29);
}

double flake_diameter_m(const World& world, std::uint32_t id)
{
    const std::uint32_t hash = mix32(mix32(id ^ static_cast<std::uint32_t>(world.seed)));
    const double u = ((hash >> 8) + 0.5) / 16777216.0;
    const double melted_mm = -std::log(u) * static_cast<double>(mean_melted_mm(world.snow));
    return std::clamp(std::sqrt(melted_mm * melted_mm * melted_mm / 0.17), 0.2, 20.0) * 1e-3;
}

}  // namespace spindrift::gl
