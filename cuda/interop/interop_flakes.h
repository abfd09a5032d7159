// SPDX-License-Identifier: MIT
#pragma once

#include "cuda/interop/drawn_memory.h"
#include "cuda/interop/registered_buffers.h"

namespace spindrift::gpu
{

/// Kernels write the buffers that GL draws from; nothing is copied. Both buffers are mapped in one call and
/// unmapped before GL draws.
class InteropFlakes final : public DrawnMemory
{
  public:
    /// Throws Error if GL has no room, or CUDA cannot register its buffers.
    explicit InteropFlakes(std::size_t capacity, const GraphicsCalls& calls = {});

    std::size_t capacity() const override { return buffers_.capacity(); }
    std::size_t bytes() const override { return buffers_.bytes(); }
    FlakeAddresses map(StreamRef stream) override;
    void hand_over(StreamRef stream, std::size_t used, const DrawList& list) override;
    void unmap(StreamRef stream) override;
    const gl::FlakeBuffers& drawn_from() const override { return buffers_; }

  private:
    gl::FlakeBuffers buffers_;
    RegisteredBuffers registered_;
};

}  // namespace spindrift::gpu
