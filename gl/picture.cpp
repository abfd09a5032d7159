// SPDX-License-Identifier: MIT
#include "gl/picture.h"

#include <fmt/format.h>

#include "core/error.h"

namespace spindrift::gl
{

namespace
{

int checked_size(int width_px, int height_px)
{
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (width_px < 1 || height_px < 1 || width_px > most || height_px > most)
        throw Error(fmt::format("a picture of {}x{} px cannot be drawn here; use 1 to {} px each way",
                                width_px, height_px, most));
    return width_px;
}

int tiles(int px)
{
    return (px + Picture::kTilePx - 1) / Picture::kTilePx;
}

}  // namespace

Picture::Picture(int width_px, int height_px)
    : width(checked_size(width_px, height_px)),
      height(height_px),
      linear(make_texture_2d(GL_RGBA16F, width, height)),
      depth(make_texture_2d(GL_DEPTH_COMPONENT32F, width, height)),
      depth_copy(make_texture_2d(GL_DEPTH_COMPONENT32F, width, height)),
      depth_tiles(make_texture_2d(GL_R32F, tiles(width), tiles(height))),
      display(make_texture_2d(GL_RGBA8, width, height)),
      linear_target(make_framebuffer()),
      tiles_target(make_framebuffer()),
      display_target(make_framebuffer())
{
    glNamedFramebufferTexture(linear_target.name(), GL_COLOR_ATTACHMENT0, linear.name(), 0);
    glNamedFramebufferTexture(linear_target.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
    glNamedFramebufferTexture(tiles_target.name(), GL_COLOR_ATTACHMENT0, depth_tiles.name(), 0);
    glNamedFramebufferTexture(display_target.name(), GL_COLOR_ATTACHMENT0, display.name(), 0);
    require_complete(linear_target, "float picture");
    require_complete(tiles_target, "depth tiles");
    require_complete(display_target, "display picture");
}

void Picture::copy_depth() const
{
    glCopyImageSubData(depth.name(), GL_TEXTURE_2D, 0, 0, 0, 0, depth_copy.name(), GL_TEXTURE_2D, 0, 0, 0, 0,
                       width, height, 1);
}

}  // namespace spindrift::gl
