// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "cuda/buffer.h"
#include "cuda/interop/drawn_memory.h"

namespace spindrift::gpu
{

/// Where OpenGL and CUDA cannot share: the flakes live on the device, and those that are drawn are gathered
/// in the order of drawing, copied through page-locked memory piece by piece, and given to GL. 16 bytes a
/// drawn flake travel; GL's own draw list stays 0, 1, 2, ... for good.
class PinnedFlakes final : public DrawnMemory
{
  public:
    /// Throws Error if GL, the device or the host has no room.
    explicit PinnedFlakes(std::size_t capacity);

    std::size_t capacity() const override { return device_.capacity(); }
    std::size_t bytes() const override;
    FlakeAddresses map(StreamRef stream) override { return device_.map(stream); }
    /// Waits for the copies.
    void hand_over(StreamRef stream, std::size_t used, const DrawList& list) override;
    void unmap(StreamRef stream) override { device_.unmap(stream); }
    const gl::FlakeBuffers& drawn_from() const override { return buffers_; }

  private:
    /// One of the pieces under way: while the host gives one to GL, the next one is copied.
    struct Piece
    {
        DeviceBuffer<std::uint32_t> device;
        PinnedBuffer<std::uint32_t> host;
        Event copied;
    };
    void number_draw_lists();
    void fetch(StreamRef stream, Piece& piece, const FlakeView& flakes, const std::uint64_t* pairs,
               std::size_t count);
    void give_to_gl(const Piece& piece, std::size_t first, std::size_t count) const;

    DeviceFlakes device_;
    gl::FlakeBuffers buffers_;
    std::size_t piece_flakes_;
    std::array<Piece, 2> pieces_;
};

}  // namespace spindrift::gpu
