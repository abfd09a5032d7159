// SPDX-License-Identifier: MIT
#include "cuda/sort/network_steps.h"

#include <algorithm>
#include <utility>

#include "cuda/launch.cuh"
#include "cuda/sort/put_in_order.cuh"

namespace spindrift::gpu
{

namespace
{

constexpr std::size_t kTile = kNetworkTile;  // 32 KiB of shared memory
constexpr unsigned kTileThreads = 512;
constexpr int kMostTileSteps = 96;  // the first twelve stages have 78
constexpr std::size_t kMostOddEvenSteps = 1024;

struct AcrossTiles
{
    std::uint64_t* pairs;
    NetworkStep step;
    __device__ void operator()(std::size_t c) const
    {
        const std::size_t upper = step.upper(c);
        put_in_order(pairs[step.lower(upper)], pairs[upper]);
    }
};

/// Several steps on a tile a block. The last tile ends where the pairs end.
struct InTiles
{
    std::uint64_t* pairs;
    std::size_t n;
    int count;
    NetworkStep steps[kMostTileSteps];

    __device__ void operator()() const
    {
        __shared__ std::uint64_t tile[kTile];
        const std::size_t first = blockIdx.x * kTile;
        const std::size_t size = n - first < kTile ? n - first : kTile;
        for (std::size_t i = threadIdx.x; i < size; i += kTileThreads) tile[i] = pairs[first + i];
        for (int s = 0; s < count; ++s)
        {
            __syncthreads();
            const NetworkStep step = steps[s];
            const std::size_t comparators = step.comparators(size);
            for (std::size_t c = threadIdx.x; c < comparators; c += kTileThreads)
            {
                const std::size_t upper = step.upper(c);
                put_in_order(tile[step.lower(upper)], tile[upper]);
            }
        }
        __syncthreads();
        for (std::size_t i = threadIdx.x; i < size; i += kTileThreads) pairs[first + i] = tile[i];
    }
};

/// Steps between neighbours on a window a block. What lies outside the window is missed by one element more
/// on each side with every step, so a block writes only the middle.
struct OddEvenWindows
{
    const std::uint64_t* from;
    std::uint64_t* to;
    std::size_t n;
    int count;
    std::uint32_t first_offset;  // of the first step: 0 or 1

    __host__ __device__ std::size_t middle() const { return kTile - 2 * margin(); }
    __host__ __device__ std::size_t margin() const { return static_cast<std::size_t>(count + 1) & ~1UL; }

    __device__ void operator()() const
    {
        __shared__ std::uint64_t window[kTile];
        const std::size_t written = blockIdx.x * middle();
        // even, so that offsets count from the window as they do from the beginning
        const std::size_t first = written < margin() ? 0 : written - margin();
        const std::size_t wanted_end = written + middle() + margin();
        const std::size_t end = wanted_end < n ? wanted_end : n;
        const std::size_t size = end - first;
        for (std::size_t i = threadIdx.x; i < size; i += kTileThreads) window[i] = from[first + i];
        for (int s = 0; s < count; ++s)
        {
            __syncthreads();
            const NetworkStep step{1, 1, (first_offset + static_cast<std::uint32_t>(s)) & 1U};
            const std::size_t comparators = step.comparators(size);
            for (std::size_t c = threadIdx.x; c < comparators; c += kTileThreads)
            {
                const std::size_t upper = step.upper(c);
                put_in_order(window[step.lower(upper)], window[upper]);
            }
        }
        __syncthreads();
        const std::size_t written_end = written + middle() < n ? written + middle() : n;
        for (std::size_t i = written + threadIdx.x; i < written_end; i += kTileThreads)
            to[i] = window[i - first];
    }
};

unsigned blocks_of(std::size_t n, std::size_t each)
{
    return static_cast<unsigned>((n + each - 1) / each);
}

}  // namespace

void run_network(StreamRef stream, NetworkWalk& walk, std::uint64_t* pairs, std::size_t n, std::size_t steps)
{
    if (n < 2) return;
    InTiles together{pairs, n, 0, {}};
    const auto run_together = [&]
    {
        if (together.count > 0)
            launch_blocks(stream, "sort: network steps in tiles", blocks_of(n, kTile), kTileThreads,
                          together);
        together.count = 0;
    };
    for (std::size_t s = 0; s < steps; ++s)
    {
        const NetworkStep step = walk.next(n);
        const bool stays = step.stays_in_tiles_of(kTile);
        if (!stays || together.count == kMostTileSteps) run_together();
        if (stays)
            together.steps[together.count++] = step;
        else
            launch(stream, "sort: network step", step.comparators(n), AcrossTiles{pairs, step});
    }
    run_together();
}

std::uint64_t* run_odd_even(StreamRef stream, NetworkWalk& walk, std::uint64_t* pairs, std::uint64_t* other,
                            std::size_t n, std::size_t steps)
{
    if (n < 2) return pairs;
    while (steps > 0)
    {
        const auto count = static_cast<int>(std::min(steps, kMostOddEvenSteps));
        const NetworkStep first = walk.next(n);
        for (int s = 1; s < count; ++s) walk.next(n);
        const OddEvenWindows body{pairs, other, n, count, first.offset};
        launch_blocks(stream, "sort: odd-even steps", blocks_of(n, body.middle()), kTileThreads, body);
        std::swap(pairs, other);
        steps -= static_cast<std::size_t>(count);
    }
    return pairs;
}

}  // namespace spindrift::gpu
