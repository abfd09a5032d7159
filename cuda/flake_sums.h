// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/flake_extent.h"
#include "cuda/buffer.h"
#include "cuda/step_control.h"

namespace spindrift::gpu
{

/// Sums over all flakes. Each waits for its result.
class FlakeSums
{
  public:
    FlakeSums();

    /// Of flake_hash over the living flakes, modulo 2^64.
    std::uint64_t hash(StreamRef stream, const StepControl* control, std::size_t capacity,
                       const FlakeView& flakes);
    FlakeExtent extent(StreamRef stream, const StepControl* control, std::size_t capacity,
                       const FlakeView& flakes);

  private:
    DeviceBuffer<unsigned long long> sum_;
    DeviceBuffer<FlakeExtent> extent_;
};

}  // namespace spindrift::gpu
