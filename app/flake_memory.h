// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "core/backend.h"
#include "core/flake.h"
#include "gl/flake_buffers.h"

namespace spindrift::app
{

/// Where the flakes of a run live, and how they come to where GL draws from.
class FlakeMemory
{
  public:
    virtual ~FlakeMemory() = default;
    virtual std::size_t bytes() const = 0;  ///< of all its buffers
    /// What the renderer draws from; null without GL.
    virtual const gl::FlakeBuffers* drawn_from() const = 0;
    /// Makes slots [0, used) and the list visible to GL. Free where the simulation writes GL's memory.
    virtual void hand_over(std::size_t used, const DrawList& list) = 0;
    /// How many slots GL can read then: fewer where only those of the list are copied.
    virtual std::uint64_t readable(const DrawList& list) const { return list.slots; }
};

/// What the CPU can address.
class HostFlakeMemory : public FlakeMemory
{
  public:
    virtual FlakeView flakes() const = 0;
    virtual DrawListView draw_list() const = 0;
};

/// No GL: host memory.
std::unique_ptr<HostFlakeMemory> make_host_memory(std::size_t capacity);
/// The simulation writes GL's buffers. Needs a current context.
std::unique_ptr<HostFlakeMemory> make_shared_memory(std::size_t capacity);
/// The simulation writes host memory, which is copied to GL's buffers for each frame. Needs a current
/// context.
std::unique_ptr<HostFlakeMemory> make_staged_memory(std::size_t capacity);

}  // namespace spindrift::app
