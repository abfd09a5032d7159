// SPDX-License-Identifier: MIT
#pragma once

#include <GL/glew.h>

#include <string>
#include <utility>

namespace spindrift::gl
{

/// Move-only owner of one GL name; `Kind` makes it and frees it. Empty after being moved from.
template <class Kind>
class Object
{
  public:
    Object() = default;
    explicit Object(GLuint name) : name_(name) {}
    Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Object& operator=(Object&& other) noexcept
    {
        if (this != &other)
        {
            reset();
            name_ = std::exchange(other.name_, 0);
        }
        return *this;
    }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    ~Object() { reset(); }

    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

  private:
    void reset()
    {
        if (name_ != 0) Kind::free(name_);
        name_ = 0;
    }
    GLuint name_ = 0;
};

struct BufferKind
{
    static void free(GLuint name) { glDeleteBuffers(1, &name); }
};
struct TextureKind
{
    static void free(GLuint name) { glDeleteTextures(1, &name); }
};
struct FramebufferKind
{
    static void free(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct VertexArrayKind
{
    static void free(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct QueryKind
{
    static void free(GLuint name) { glDeleteQueries(1, &name); }
};
struct SamplerKind
{
    static void free(GLuint name) { glDeleteSamplers(1, &name); }
};

using Buffer = Object<BufferKind>;
using Texture = Object<TextureKind>;
using Framebuffer = Object<FramebufferKind>;
using VertexArray = Object<VertexArrayKind>;
using Query = Object<QueryKind>;
using Sampler = Object<SamplerKind>;

// All storage but make_lent_buffer()'s is immutable (direct state access).

Buffer make_buffer(GLsizeiptr bytes, const void* data, GLbitfield flags);
/// For buffers that another API fills: of the usual kind that any driver lends out, kept beside the GPU.
Buffer make_lent_buffer(GLsizeiptr bytes, const void* data);
Texture make_texture_2d(GLenum format, int width, int height);
Framebuffer make_framebuffer();
VertexArray make_vertex_array();
Query make_query(GLenum target);
/// Linear, with GL_CLAMP_TO_EDGE or GL_CLAMP_TO_BORDER (black).
Sampler make_linear_sampler(GLint wrap);

/// Throws Error unless the framebuffer can be drawn to; `what` names it.
void require_complete(const Framebuffer& framebuffer, const std::string& what);

}  // namespace spindrift::gl
