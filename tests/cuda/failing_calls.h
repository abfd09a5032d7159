// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "cuda/interop/graphics_calls.h"

namespace spindrift::gpu
{

/// The real calls, counted, with failures put in: what drivers do on machines that are not here.
class FailingCalls
{
  public:
    /// Which calls answer `code` instead of being made; `after` calls of that kind are still made.
    enum class Which
    {
        none,
        devices,
        registering,
        mapping,
        addresses,
        unmapping,
    };
    static constexpr int kNoDevice = -1;  ///< cudaGLGetDevices succeeds and names none

    FailingCalls() : FailingCalls(Which::none, cudaSuccess) {}
    FailingCalls(Which which, cudaError_t code, int after = 0);

    /// The table to hand out. Only the newest FailingCalls is asked: plain function pointers carry no state.
    GraphicsCalls calls() const;

    void name_device(int ordinal);         ///< cudaGLGetDevices names this one
    void misdirect_kernels(void* memory);  ///< mapped buffers seem to lie here

    struct Counts
    {
        int registered = 0, unregistered = 0;
        int map_calls = 0, unmap_calls = 0;
        int most_mapped_at_once = 0;
        int unregistered_after_gl_freed = 0;
    };
    Counts counts() const;
};

}  // namespace spindrift::gpu
