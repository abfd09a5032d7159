// SPDX-License-Identifier: MIT
#pragma once

#include <GL/glew.h>

#include "core/vec.h"
#include "gl/object.h"
#include "gl/program.h"

namespace spindrift::gl
{

/// Finds on the GPU how many flakes of a sorted list are farther than a border, for lists that the host
/// cannot read. The answer stays there, as the arguments of two draws.
class FlakeSplit
{
  public:
    FlakeSplit();

    /// The arrays and the list are bound as for drawing. Leaves the arguments bound to
    /// GL_DRAW_INDIRECT_BUFFER.
    void search(GLsizei count, const Vec3f& eye_m, double border_m) const;

    // Where the arguments of the draws begin, for glDrawArraysIndirect.
    static const void* beyond() { return nullptr; }
    static const void* within() { return reinterpret_cast<const void*>(kCommandBytes); }

  private:
    static constexpr GLsizeiptr kCommandBytes = 16;
    Program program_;
    Buffer commands_;
};

}  // namespace spindrift::gl
