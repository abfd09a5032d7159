// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/flake.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

/// What GL needs of a flake: x, y, z as bits, and id.
inline constexpr std::size_t kDrawnArrays = 4;

/// Queues: array a of flake i of the list goes to to[a * stride + i], for i in [0, count).
void gather_drawn(StreamRef stream, const FlakeView& flakes, const std::uint64_t* pairs, std::size_t count,
                  std::uint32_t* to, std::size_t stride);

}  // namespace spindrift::gpu
