// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/backend.h"
#include "core/flake.h"
#include "cuda/buffer.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

/// Device addresses of the arrays. They hold only between map() and unmap() of the memory that gave them, and
/// may be others the next time.
struct FlakeAddresses
{
    FlakeView flakes{};
    DrawListView draw_list{};
};

inline bool operator==(const FlakeAddresses& a, const FlakeAddresses& b)
{
    return a.flakes.x == b.flakes.x && a.flakes.state == b.flakes.state &&
           a.draw_list.pairs == b.draw_list.pairs && a.draw_list.scratch == b.draw_list.scratch;
}

/// Who owns the arrays that kernels write: the device alone, or GL. Strictly map, work, hand_over (if
/// somebody is to draw), unmap.
class FlakeMemory
{
  public:
    virtual ~FlakeMemory() = default;
    virtual std::size_t capacity() const = 0;  ///< elements of every array
    virtual std::size_t bytes() const = 0;     ///< of all its buffers, wherever they lie

    /// Work queued on `stream` from now on may use the addresses. Throws Error.
    virtual FlakeAddresses map(StreamRef stream) = 0;
    /// Makes the slots [0, used) and the list known to who draws them, where they are not in the same memory;
    /// called while mapped, behind the work that made them.
    virtual void hand_over(StreamRef stream, std::size_t used, const DrawList& list) = 0;
    /// Everything queued on `stream` is done before anybody else reads. Throws Error.
    virtual void unmap(StreamRef stream) = 0;
};

/// Keeps a memory mapped as long as it lives.
class MappedFlakes
{
  public:
    MappedFlakes(FlakeMemory& memory, StreamRef stream)
        : memory_(memory), stream_(stream), addresses_(memory.map(stream))
    {
    }
    /// Unmaps if close() was not called; a failure is not reported then.
    ~MappedFlakes()
    {
        if (!mapped_) return;
        try
        {
            memory_.unmap(stream_);
        }
        catch (...)
        {
        }
    }
    MappedFlakes(const MappedFlakes&) = delete;
    MappedFlakes& operator=(const MappedFlakes&) = delete;

    const FlakeAddresses& addresses() const { return addresses_; }
    /// Unmaps now and reports failures.
    void close()
    {
        mapped_ = false;
        memory_.unmap(stream_);
    }

  private:
    FlakeMemory& memory_;
    StreamRef stream_;
    FlakeAddresses addresses_;
    bool mapped_ = true;
};

/// Plain device memory, for runs without GL.
class DeviceFlakes final : public FlakeMemory
{
  public:
    /// Throws Error if the device has not got kStateBytesPerFlake + kDrawListBytesPerFlake bytes a flake.
    explicit DeviceFlakes(std::size_t capacity);

    std::size_t capacity() const override { return capacity_; }
    std::size_t bytes() const override { return words_.bytes() + pairs_.bytes(); }
    FlakeAddresses map(StreamRef stream) override;
    void hand_over(StreamRef stream, std::size_t used, const DrawList& list) override;
    void unmap(StreamRef stream) override;

  private:
    std::size_t capacity_;
    std::size_t stride_;  ///< elements from one array to the next: whole 64-byte lines
    DeviceBuffer<std::uint32_t> words_;
    DeviceBuffer<std::uint64_t> pairs_;
};

}  // namespace spindrift::gpu
