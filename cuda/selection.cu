// SPDX-License-Identifier: MIT
#include "cuda/selection.h"

#include "cuda/launch.cuh"

namespace spindrift::gpu
{

namespace
{

constexpr unsigned kScanThreads = 256;

/// One block: each thread adds up a stretch of tiles, the stretches are added up, and each thread goes over
/// its stretch again. 16 million slots are 16 384 tiles, 64 a thread.
struct NumberTiles
{
    const std::uint32_t* count;
    Selection selection;
    std::uint32_t* total;

    __device__ void operator()() const
    {
        __shared__ std::uint32_t sums[kScanThreads];
        const std::size_t tiles = selection_tiles(*count);
        const std::size_t stretch = (tiles + kScanThreads - 1) / kScanThreads;
        const std::size_t first = min(threadIdx.x * stretch, tiles);
        const std::size_t last = min(first + stretch, tiles);
        std::uint32_t sum = 0;
        for (std::size_t t = first; t < last; ++t) sum += selection.tile_starts[t];
        sums[threadIdx.x] = sum;
        __syncthreads();
        for (unsigned reach = 1; reach < kScanThreads; reach *= 2)
        {
            const std::uint32_t before = threadIdx.x >= reach ? sums[threadIdx.x - reach] : 0;
            __syncthreads();
            sums[threadIdx.x] += before;
            __syncthreads();
        }
        if (threadIdx.x == kScanThreads - 1) *total = sums[threadIdx.x];
        std::uint32_t start = sums[threadIdx.x] - sum;
        for (std::size_t t = first; t < last; ++t)
        {
            const std::uint32_t in_tile = selection.tile_starts[t];
            selection.tile_starts[t] = start;
            start += in_tile;
        }
    }

  private:
    static __device__ std::size_t min(std::size_t a, std::size_t b) { return a < b ? a : b; }
};

}  // namespace

void number_tiles(StreamRef stream, const std::uint32_t* count, const Selection& selection,
                  std::uint32_t* total)
{
    launch_blocks(stream, "number tiles", 1, kScanThreads, NumberTiles{count, selection, total});
}

}  // namespace spindrift::gpu
