// SPDX-License-Identifier: MIT
#include "gl/flake_split.h"

#include <array>
#include <string_view>

#include "gl/frame_constants.h"

namespace spindrift::gl
{

namespace
{

constexpr std::array<std::string_view, 1> kFiles{"flake_split.comp"};
constexpr GLint kCount = 0;
constexpr GLint kEye = 1;
constexpr GLint kBorder = 2;

}  // namespace

FlakeSplit::FlakeSplit()
    : program_(make_program(kFiles)), commands_(make_buffer(2 * kCommandBytes, nullptr, 0))
{
}

void FlakeSplit::search(GLsizei count, const Vec3f& eye_m, double border_m) const
{
    const GLuint program = program_.name();
    glProgramUniform1ui(program, kCount, static_cast<GLuint>(count));
    glProgramUniform3f(program, kEye, eye_m.x, eye_m.y, eye_m.z);
    glProgramUniform1d(program, kBorder, border_m);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kDrawCommands, commands_.name());
    glUseProgram(program);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.name());
}

}  // namespace spindrift::gl
