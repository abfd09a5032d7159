// SPDX-License-Identifier: MIT
#include "gl/full_screen_pass.h"

#include <array>

namespace spindrift::gl
{

FullScreenPass::FullScreenPass(std::string_view vertex_file, std::string_view fragment_file,
                               std::span<const std::string_view> defines)
    : program_(make_program(std::array{vertex_file, fragment_file}, defines)), nothing_(make_vertex_array())
{
}

void FullScreenPass::bind() const
{
    glUseProgram(program_.name());
    glBindVertexArray(nothing_.name());
}

void FullScreenPass::draw() const
{
    bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void FullScreenPass::draw_commanded(GLuint command_buffer) const
{
    bind();
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, command_buffer);
    glDrawArraysIndirect(GL_TRIANGLES, nullptr);
}

}  // namespace spindrift::gl
