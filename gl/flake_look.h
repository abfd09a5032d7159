// SPDX-License-Identifier: MIT
#pragma once

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

}  // namespace spindrift::gl
