// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <cuda_runtime.h>
#include <nvtx3/nvtx3.hpp>

#include "cuda/check.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

inline constexpr unsigned kBlockThreads = 256;

/// Blocks of kBlockThreads that are enough to fill any device; loops over indices stride by what was
/// launched, so that a device-side count may be anything.
inline constexpr unsigned kMostBlocks = 1U << 16;

template <class Body>
__global__ void run_body(Body body)
{
    body();
}

/// A body that says how many of its blocks, and of how many threads, must fit on a multiprocessor at least:
/// it gets no more registers than that leaves it.
template <class Body>
concept Crowded = requires
{
    Body::kThreads;
    Body::kLeastResidentBlocks;
};

template <Crowded Body>
__global__ void __launch_bounds__(Body::kThreads, Body::kLeastResidentBlocks) run_crowded_body(Body body)
{
    body();
}

template <class Body>
constexpr auto kernel_of()
{
    if constexpr (Crowded<Body>)
        return &run_crowded_body<Body>;
    else
        return &run_body<Body>;
}

/// Runs `body()` in every thread of a grid; the one place where anything is launched. `name` shows in the
/// profiler and in errors. No blocks: nothing happens. Throws Error for what the launch itself returned.
template <class Body>
void launch_blocks(StreamRef stream, const char* name, unsigned blocks, unsigned threads, const Body& body)
{
    static_assert(std::is_trivially_copyable_v<Body>, "kernels take plain data");
    if (blocks == 0) return;
    const nvtx3::scoped_range range(name);
    auto* const kernel = kernel_of<Body>();
    kernel<<<blocks, threads, 0, stream.get()>>>(body);
    const cudaError_t code = cudaGetLastError();
    if (code != cudaSuccess) throw_launch_failed(code, name, blocks, threads);
}

template <class Function>
struct ForEachIndex
{
    std::size_t count;
    Function function;

    __device__ void operator()() const
    {
        const std::size_t stride = std::size_t{gridDim.x} * blockDim.x;
        for (std::size_t i = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x; i < count; i += stride)
            function(i);
    }
};

/// As ForEachIndex, but how many there are stands on the device.
template <class Function>
struct ForEachCounted
{
    const std::uint32_t* count;
    Function function;

    __device__ void operator()() const { ForEachIndex<Function>{*count, function}(); }
};

inline unsigned blocks_for(std::size_t count, unsigned threads = kBlockThreads)
{
    return static_cast<unsigned>(std::min<std::size_t>((count + threads - 1) / threads, kMostBlocks));
}

/// Calls `function(i)` for i in [0, count), in any order.
template <class Function>
void launch(StreamRef stream, const char* name, std::size_t count, const Function& function)
{
    launch_blocks(stream, name, blocks_for(count), kBlockThreads, ForEachIndex<Function>{count, function});
}

/// Calls `function(i)` for i in [0, *count), where the count is the device's own and at most `most`.
template <class Function>
void launch_counted(StreamRef stream, const char* name, const std::uint32_t* count, std::size_t most,
                    const Function& function)
{
    launch_blocks(stream, name, blocks_for(most), kBlockThreads, ForEachCounted<Function>{count, function});
}

}  // namespace spindrift::gpu
