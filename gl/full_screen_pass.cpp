// SPDX-License-Identifier: MIT
#include "gl/full_screen_pass.h"

#include <array>

namespace spindrift::gl
{

FullScreenPass::FullScreenPass(std::string_view vertex_file, std::string_view fragment_file)
    : program_(make_program(std::array{vertex_file, fragment_file})), nothing_(make_vertex_array())
{
}

void FullScreenPass::draw() const
{
    glUseProgram(program_.name());
    glBindVertexArray(nothing_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace spindrift::gl
