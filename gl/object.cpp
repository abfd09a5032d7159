// SPDX-License-Identifier: MIT
#include "gl/object.h"

#include <fmt/format.h>

#include "core/error.h"

namespace spindrift::gl
{

Buffer make_buffer(GLsizeiptr bytes, const void* data, GLbitfield flags)
{
    GLuint name = 0;
    glCreateBuffers(1, &name);
    Buffer buffer(name);
    // Buffers of no bytes are an error in GL; the smallest one serves.
    glNamedBufferStorage(name, bytes > 0 ? bytes : 16, bytes > 0 ? data : nullptr, flags);
    return buffer;
}

Buffer make_lent_buffer(GLsizeiptr bytes, const void* data)
{
    GLuint name = 0;
    glCreateBuffers(1, &name);
    Buffer buffer(name);
    glNamedBufferData(name, bytes, data, GL_DYNAMIC_COPY);
    return buffer;
}

Texture make_texture_2d(GLenum format, int width, int height)
{
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    Texture texture(name);
    glTextureStorage2D(name, 1, format, width, height);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

Framebuffer make_framebuffer()
{
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    return Framebuffer(name);
}

VertexArray make_vertex_array()
{
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    return VertexArray(name);
}

Query make_query(GLenum target)
{
    GLuint name = 0;
    glCreateQueries(target, 1, &name);
    return Query(name);
}

Sampler make_linear_sampler(GLint wrap)
{
    GLuint name = 0;
    glCreateSamplers(1, &name);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glSamplerParameteri(name, filter, GL_LINEAR);
    for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) glSamplerParameteri(name, side, wrap);
    return Sampler(name);
}

void require_complete(const Framebuffer& framebuffer, const std::string& what)
{
    const GLenum status = glCheckNamedFramebufferStatus(framebuffer.name(), GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return;
    throw Error(fmt::format(
        "OpenGL cannot draw to the {} (framebuffer status 0x{:04x}); try a smaller picture or another driver",
        what, status));
}

}  // namespace spindrift::gl
