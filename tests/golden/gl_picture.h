// SPDX-License-Identifier: MIT
#pragma once

#include "core/splatter.h"
#include "image/image.h"
#include "tests/golden/small_scenes.h"

namespace spindrift::golden
{

struct GlPicture
{
    image::Image linear;    ///< the float target
    image::Image8 display;  ///< after the tone curve
    std::string errors;     ///< what the driver complained of; empty when all is well
};

/// Of the draw list; over-blending needs the first.
enum class Order
{
    far_to_near,
    near_to_far,
};

/// Draws a small scene with gl::Renderer, its flakes handed over in the exact order. Needs a
/// current context.
GlPicture draw_with_gl(SmallScene& small, Order order = Order::far_to_near);
GlPicture draw_with_gl(SmallScene& small, Splatter& splatter, Order order = Order::far_to_near);

}  // namespace spindrift::golden
