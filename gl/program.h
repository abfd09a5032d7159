// SPDX-License-Identifier: MIT
#pragma once

#include <GL/glew.h>

#include <span>
#include <string>
#include <string_view>

#include "gl/object.h"

namespace spindrift::gl
{

struct ProgramKind
{
    static void free(GLuint name) { glDeleteProgram(name); }
};
using Program = Object<ProgramKind>;

/// Text of a file of shaders/, embedded at build time. Throws Error for a name that is not there.
std::string_view shader_source(std::string_view file);

/// Compiles and links files of shaders/ (.vert, .frag, .comp). `defines` become "#define X" lines behind
/// #version; a line `#include "file"` is replaced by that file. Throws Error naming the file and the driver's
/// first complaint.
Program make_program(std::span<const std::string_view> files, std::span<const std::string_view> defines = {});

}  // namespace spindrift::gl
