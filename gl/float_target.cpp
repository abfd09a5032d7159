// SPDX-License-Identifier: MIT
#include "gl/float_target.h"

namespace spindrift::gl
{

FloatTarget::FloatTarget(GLenum format, int width_px, int height_px)
    : width(width_px),
      height(height_px),
      texture(make_texture_2d(format, width_px, height_px)),
      framebuffer(make_framebuffer())
{
    glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
    require_complete(framebuffer, "picture between two passes");
}

void FloatTarget::bind() const
{
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glViewport(0, 0, width, height);
}

}  // namespace spindrift::gl
