// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cuda/interop/graphics_calls.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

/// GL buffers that kernels write: registered once, mapped all together. Declare it behind their owner, so
/// that they are unregistered before GL frees them.
class RegisteredBuffers
{
  public:
    /// Throws Error if OpenGL and CUDA cannot share them; nothing stays registered then.
    explicit RegisteredBuffers(std::span<const GLuint> buffers, const GraphicsCalls& calls = {});
    ~RegisteredBuffers();
    RegisteredBuffers(const RegisteredBuffers&) = delete;
    RegisteredBuffers& operator=(const RegisteredBuffers&) = delete;

    /// What GL was asked for before is done before any work that is queued on `stream` from now on. Throws
    /// Error.
    void map(StreamRef stream);
    /// Device address of a buffer, by the order in which they were named; only between map() and unmap().
    void* address(std::size_t index) const { return addresses_[index]; }
    /// What is queued on `stream` is done before GL does what it is asked for from now on. Throws Error.
    void unmap(StreamRef stream);

  private:
    void unregister() noexcept;

    GraphicsCalls calls_;
    std::vector<cudaGraphicsResource_t> resources_;
    std::vector<void*> addresses_;  ///< empty: not mapped
};

}  // namespace spindrift::gpu
