// SPDX-License-Identifier: MIT
#pragma once

#include "gl/object.h"

namespace spindrift::gl
{

/// A texture of floats that a pass draws into and the next one reads.
struct FloatTarget
{
    FloatTarget(GLenum format, int width_px, int height_px);

    /// Draws go here, over all of it.
    void bind() const;

    int width, height;
    Texture texture;
    Framebuffer framebuffer;
};

}  // namespace spindrift::gl
