// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "cuda/launch.cuh"
#include "cuda/selection.h"

namespace spindrift::gpu
{

/// One thread a slot: marks who is chosen, in words of 32 slots, and counts them by tile.
template <class Chosen>
struct MarkChosen
{
    const std::uint32_t* count;
    Selection selection;
    Chosen chosen;

    __device__ void operator()() const
    {
        const std::size_t n = *count;
        const std::size_t tiles = selection_tiles(n);
        for (std::size_t tile = blockIdx.x; tile < tiles; tile += gridDim.x)
        {
            const std::size_t i = tile * kSelectionTile + threadIdx.x;
            const bool mine = i < n && chosen(i);
            const unsigned word = __ballot_sync(0xFFFFFFFFU, mine);
            if (threadIdx.x % 32 == 0) selection.words[i / 32] = word;
            const int in_tile = __syncthreads_count(mine);
            if (threadIdx.x == 0) selection.tile_starts[tile] = static_cast<std::uint32_t>(in_tile);
        }
    }
};

/// Calls `write(i, rank)` for those who were chosen, in any order.
template <class Write>
struct WriteChosen
{
    Selection selection;
    Write write;

    __device__ void operator()(std::size_t i) const
    {
        const std::uint32_t word = selection.words[i / 32];
        const std::uint32_t bit = 1U << (i % 32);
        if ((word & bit) == 0) return;
        const std::size_t tile = i / kSelectionTile;
        std::uint32_t rank = selection.tile_starts[tile];
        for (std::size_t w = tile * (kSelectionTile / 32); w < i / 32; ++w)
            rank += static_cast<std::uint32_t>(__popc(selection.words[w]));
        write(i, rank + static_cast<std::uint32_t>(__popc(word & (bit - 1))));
    }
};

/// Numbers those of the slots [0, *count) for which `chosen(i)` holds, in slot order, and calls
/// `write(i, rank)` for each. `total` (device) gets how many there are.
template <class Chosen, class Write>
void select(StreamRef stream, const char* name, const std::uint32_t* count, std::size_t most,
            const Selection& selection, std::uint32_t* total, const Chosen& chosen, const Write& write)
{
    const std::size_t tiles = std::min<std::size_t>(selection_tiles(most), kMostBlocks);
    launch_blocks(stream, name, static_cast<unsigned>(tiles), kSelectionTile,
                  MarkChosen<Chosen>{count, selection, chosen});
    number_tiles(stream, count, selection, total);
    launch_counted(stream, name, count, most, WriteChosen<Write>{selection, write});
}

}  // namespace spindrift::gpu
