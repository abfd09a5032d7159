// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "cuda/buffer.h"
#include "cuda/step_control.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

/// Copies of the device's StepControl that arrive when they arrive.
class LateControl
{
  public:
    LateControl();

    /// Queues a copy of what the work before it leaves.
    void ask(StreamRef stream, const StepControl* device);
    /// The newest that has arrived; never waits.
    const StepControl& newest();
    /// What the newest ask() asked for.
    const StepControl& wait();
    /// Nothing was asked for; this is known.
    void set(const StepControl& known);

  private:
    /// The host may be this many steps ahead and still learn of one.
    static constexpr std::size_t kSlots = 16;

    PinnedBuffer<StepControl> copies_;
    std::array<Event, kSlots> arrived_;
    std::size_t asked_ = 0;        ///< how many times
    std::size_t known_asked_ = 0;  ///< which of them is known
    StepControl known_;
};

}  // namespace spindrift::gpu
