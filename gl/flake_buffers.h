// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/flake.h"

namespace spindrift::gl
{

/// Owns the flakes' memory as GL buffers. One buffer holds the eleven arrays of FlakeView back to back (each
/// padded to 256 bytes), a second the two draw lists. Needs a current context; throws Error if the memory
/// cannot be had.
class FlakeBuffers
{
  public:
    enum class Access
    {
        mapped,    ///< persistently and coherently: the CPU backend writes where the vertex shader reads
        unmapped,  ///< kept beside the GPU; kernels fill it, or copies by GL
    };

    explicit FlakeBuffers(std::size_t capacity, Access access = Access::mapped);
    ~FlakeBuffers();
    FlakeBuffers(const FlakeBuffers&) = delete;
    FlakeBuffers& operator=(const FlakeBuffers&) = delete;

    Access access() const;
    FlakeView flakes() const;                      ///< null pointers if unmapped
    DrawListView draw_list() const;                ///< null pointers if unmapped
    FlakeView flakes_at(void* state) const;        ///< the arrays, where the state buffer begins at `state`
    DrawListView draw_list_at(void* lists) const;  ///< the same of the list buffer
    std::size_t capacity() const;
    std::size_t bytes() const;           ///< of both buffers
    std::uint32_t state_buffer() const;  ///< GL name
    std::uint32_t list_buffer() const;   ///< GL name
    std::size_t array_stride() const;    ///< elements from one array of the state buffer to the next
    std::size_t list_stride() const;     ///< elements from one draw list to the other

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace spindrift::gl
