// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

namespace spindrift::cpu
{

/// Flakes that one task works on: a multiple of every pack width and of the 64 flakes of a mask word. Small
/// enough to share out 100 000 flakes, large enough that a task costs more than its start.
inline constexpr std::size_t kChunkFlakes = 4096;

inline constexpr std::size_t chunk_count(std::size_t flakes)
{
    return (flakes + kChunkFlakes - 1) / kChunkFlakes;
}

/// Slots [first, last) of chunk `c` of `used`.
struct Chunk
{
    std::size_t first, last;
    Chunk(std::size_t c, std::size_t used)
        : first(c * kChunkFlakes), last(std::min(used, (c + 1) * kChunkFlakes))
    {
    }
};

}  // namespace spindrift::cpu
