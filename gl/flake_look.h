// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/view.h"
#include "core/world.h"

namespace spindrift::gl
{

/// How small and how large a flake is drawn (docs/drawing.md).
struct SpriteLimits
{
    float smallest_px, largest_px;  ///< radius
};
/// Asks the current context for its largest point.
SpriteLimits sprite_limits(const View& view);

/// 1 / Lambda of the size spectrum, mm of melted diameter.
float mean_melted_mm(const Snow& snow);

/// Diameter of a flake before flake_scale.
double flake_diameter_m(const World& world, std::uint32_t id);

}  // namespace spindrift::gl
