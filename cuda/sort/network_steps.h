// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/sort_network.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

/// Runs the next `steps` steps of a network over n pairs in place. Steps that stay in tiles of 4096 pairs run
/// together in shared memory.
void run_network(StreamRef stream, NetworkWalk& walk, std::uint64_t* pairs, std::size_t n, std::size_t steps);

/// The same for Network::odd_even, whose neighbours cross tiles: up to 1024 steps together, from one array to
/// the other. Returns where the pairs will be.
std::uint64_t* run_odd_even(StreamRef stream, NetworkWalk& walk, std::uint64_t* pairs, std::uint64_t* other,
                            std::size_t n, std::size_t steps);

}  // namespace spindrift::gpu
