// SPDX-License-Identifier: MIT
#include "cuda/flake_sums.h"

#include <algorithm>

#include "core/state_hash.h"
#include "cuda/launch.cuh"

namespace spindrift::gpu
{

namespace
{

/// Few enough that their results can be joined one by one.
constexpr unsigned kSumBlocks = 1024;

struct SumHashes
{
    const std::uint32_t* count;
    FlakeView flakes;
    unsigned long long* total;

    __device__ void operator()() const
    {
        __shared__ unsigned long long in_block;
        if (threadIdx.x == 0) in_block = 0;
        __syncthreads();
        unsigned long long sum = 0;
        const auto add = [&](std::size_t i) { sum += flake_hash(flakes, i); };
        ForEachIndex<decltype(add)>{*count, add}();
        if (sum != 0) atomicAdd(&in_block, sum);
        __syncthreads();
        if (threadIdx.x == 0 && in_block != 0) atomicAdd(total, in_block);
    }
};

/// An extent a block; the host joins them.
struct MeasureExtents
{
    const std::uint32_t* count;
    FlakeView flakes;
    FlakeExtent* of_blocks;

    __device__ void operator()() const
    {
        // raw: shared memory has no constructors
        __shared__ alignas(FlakeExtent) unsigned char raw[kBlockThreads * sizeof(FlakeExtent)];
        auto* const of_threads = reinterpret_cast<FlakeExtent*>(raw);
        FlakeExtent extent;
        const auto take_in = [&](std::size_t i) { include(extent, flakes, i); };
        ForEachIndex<decltype(take_in)>{*count, take_in}();
        of_threads[threadIdx.x] = extent;
        for (unsigned half = kBlockThreads / 2; half > 0; half /= 2)
        {
            __syncthreads();
            if (threadIdx.x < half) include(of_threads[threadIdx.x], of_threads[threadIdx.x + half]);
        }
        if (threadIdx.x == 0) of_blocks[blockIdx.x] = of_threads[0];
    }
};

}  // namespace

FlakeSums::FlakeSums() : sum_(1), extent_(kSumBlocks) {}

std::uint64_t FlakeSums::hash(StreamRef stream, const StepControl* control, std::size_t capacity,
                              const FlakeView& flakes)
{
    check(cudaMemsetAsync(sum_.data(), 0, sum_.bytes(), stream.get()), "cudaMemsetAsync");
    launch_blocks(stream, "state hash", std::min(blocks_for(capacity), kSumBlocks), kBlockThreads,
                  SumHashes{&control->used, flakes, sum_.data()});
    unsigned long long sum = 0;
    copy_to_host(stream, &sum, sum_.data(), 1);
    stream.wait();
    return sum;
}

FlakeExtent FlakeSums::extent(StreamRef stream, const StepControl* control, std::size_t capacity,
                              const FlakeView& flakes)
{
    const unsigned blocks = std::min(blocks_for(capacity), kSumBlocks);
    launch_blocks(stream, "extent", blocks, kBlockThreads,
                  MeasureExtents{&control->used, flakes, extent_.data()});
    std::vector<FlakeExtent> parts(blocks);
    if (blocks > 0) copy_to_host(stream, parts.data(), extent_.data(), blocks);
    stream.wait();
    FlakeExtent extent;
    for (const FlakeExtent& part : parts) include(extent, part);
    return extent;
}

}  // namespace spindrift::gpu
