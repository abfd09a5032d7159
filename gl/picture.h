// SPDX-License-Identifier: MIT
#pragma once

#include "gl/object.h"

namespace spindrift::gl
{

/// What a frame is drawn into: linear RGBA16F with a float depth buffer, a copy of that depth for passes that
/// read it while they are tested against it, the farthest depth in each tile of 8x8 pixels, and the 8-bit
/// display picture.
struct Picture
{
    static constexpr int kTilePx = 8;

    Picture(int width_px, int height_px);

    int width, height;
    Texture linear, depth, depth_copy, depth_tiles, display;
    Framebuffer linear_target, tiles_target, display_target;

    void copy_depth() const;
};

}  // namespace spindrift::gl
