// SPDX-License-Identifier: MIT
#pragma once

#include "cuda/flake_memory.h"
#include "gl/flake_buffers.h"

namespace spindrift::gpu
{

/// Flakes that kernels move and GL draws. Lives and dies in the thread of one GL context.
class DrawnMemory : public FlakeMemory
{
  public:
    virtual const gl::FlakeBuffers& drawn_from() const = 0;
};

}  // namespace spindrift::gpu
