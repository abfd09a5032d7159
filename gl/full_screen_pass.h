// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "gl/object.h"
#include "gl/program.h"

namespace spindrift::gl
{

/// One triangle over the whole target.
class FullScreenPass
{
  public:
    FullScreenPass(std::string_view vertex_file, std::string_view fragment_file,
                   std::span<const std::string_view> defines = {});
    void draw() const;
    /// As often as the command in a buffer says that the GPU wrote (DrawArraysIndirectCommand).
    void draw_commanded(GLuint command_buffer) const;

    GLuint program() const { return program_.name(); }

  private:
    void bind() const;

    Program program_;
    VertexArray nothing_;
};

}  // namespace spindrift::gl
