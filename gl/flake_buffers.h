// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/flake.h"

namespace spindrift::gl
{

/// Owns the flakes' memory as GL buffers, persistently and coherently mapped: the CPU backend writes where
/// the vertex shader reads. One buffer holds the eleven arrays of FlakeView back to back (each padded to 64
/// bytes), a second the two draw lists. Needs a current context; throws Error if the memory cannot be had.
class FlakeBuffers
{
  public:
    explicit FlakeBuffers(std::size_t capacity);
    ~FlakeBuffers();
    FlakeBuffers(const FlakeBuffers&) = delete;
    FlakeBuffers& operator=(const FlakeBuffers&) = delete;

    FlakeView flakes() const;
    DrawListView draw_list() const;
    std::size_t capacity() const;
    std::size_t bytes() const;           ///< of both buffers
    std::uint32_t state_buffer() const;  ///< GL name
    std::uint32_t list_buffer() const;   ///< GL name
    std::size_t array_stride() const;    ///< elements from one array of the state buffer to the next

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace spindrift::gl
