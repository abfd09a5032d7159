// SPDX-License-Identifier: MIT
#include "bench/bare_points.h"

#include <GL/glew.h>

#include "core/error.h"

namespace spindrift::bench
{

namespace
{

constexpr const char* kVertex = R"(#version 450 core
layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
layout(location = 0) uniform vec2 picture;
void main()
{
    vec4 p = points[gl_VertexID];
    gl_Position = vec4(p.xy / picture * 2.0 - 1.0, 0.0, 1.0);
    gl_PointSize = p.z;
})";

constexpr const char* kFragment = R"(#version 450 core
layout(location = 0) out vec4 colour;
void main() { colour = vec4(0.01); })";

GLuint compiled(GLenum stage, const char* text)
{
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    return shader;
}

GLuint linked()
{
    const GLuint vertex = compiled(GL_VERTEX_SHADER, kVertex),
                 fragment = compiled(GL_FRAGMENT_SHADER, kFragment);
    const GLuint program = glCreateProgram();
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    glLinkProgram(program);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    GLint ok = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok == 0) throw Error("the program of the bare points does not link");
    return program;
}

}  // namespace

BarePoints::BarePoints(int width_px, int height_px)
    : width_px_(width_px), height_px_(height_px), program_(linked())
{
    glCreateBuffers(1, &buffer_);
    glCreateVertexArrays(1, &vertex_array_);
    glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
    glTextureStorage2D(texture_, 1, GL_RGBA16F, width_px, height_px);
    glCreateFramebuffers(1, &target_);
    glNamedFramebufferTexture(target_, GL_COLOR_ATTACHMENT0, texture_, 0);
}

BarePoints::~BarePoints()
{
    glDeleteFramebuffers(1, &target_);
    glDeleteTextures(1, &texture_);
    glDeleteVertexArrays(1, &vertex_array_);
    glDeleteBuffers(1, &buffer_);
    glDeleteProgram(program_);
}

void BarePoints::upload(const std::vector<BarePoint>& points)
{
    glNamedBufferData(buffer_, static_cast<GLsizeiptr>(points.size() * sizeof(BarePoint)), points.data(),
                      GL_STATIC_DRAW);
    count_ = static_cast<int>(points.size());
}

void BarePoints::draw() const
{
    glBindFramebuffer(GL_FRAMEBUFFER, target_);
    glViewport(0, 0, width_px_, height_px_);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(program_);
    glProgramUniform2f(program_, 0, static_cast<float>(width_px_), static_cast<float>(height_px_));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer_);
    glBindVertexArray(vertex_array_);
    glDrawArrays(GL_POINTS, 0, count_);
    glDisable(GL_BLEND);
    glFinish();
}

}  // namespace spindrift::bench
