// SPDX-License-Identifier: MIT
#include "gl/crystal_texture.h"

namespace spindrift::gl
{

Texture make_crystal_texture(std::span<const scene::CrystalMask> masks)
{
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
    Texture texture(name);
    const auto levels = static_cast<GLsizei>(masks.front().levels.size());
    glTextureStorage3D(name, levels, GL_R8, scene::kCrystalMaskPx, scene::kCrystalMaskPx,
                       static_cast<GLsizei>(masks.size()));
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    GLint alignment = 4;
    glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (std::size_t layer = 0; layer < masks.size(); ++layer)
        for (GLint level = 0; level < levels; ++level)
        {
            const int px = scene::kCrystalMaskPx >> level;
            glTextureSubImage3D(name, level, 0, 0, static_cast<GLint>(layer), px, px, 1, GL_RED,
                                GL_UNSIGNED_BYTE,
                                masks[layer].levels[static_cast<std::size_t>(level)].data());
        }
    glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
    return texture;
}

}  // namespace spindrift::gl
