// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <nv/target>

#include "core/flake.h"
#include "cuda/launch.cuh"
#include "cuda/step_control.h"

namespace spindrift::gpu
{

/// What a block counts, in its shared memory: a Tally of core/encounter.h.
struct BlockTally
{
    static constexpr unsigned kFates = 4;
    static constexpr unsigned kMostEmitters = 255;

    unsigned* by_fate;
    unsigned* by_emitter;

    __host__ __device__ void count([[maybe_unused]] unsigned* at) const
    {
        NV_IF_TARGET(NV_IS_DEVICE, (atomicAdd(at, 1U);))
    }
    __host__ __device__ void ended(Fate fate) const { count(&by_fate[static_cast<unsigned>(fate)]); }
    __host__ __device__ void lose(std::uint32_t emitter) const { count(&by_emitter[emitter]); }
};

/// Calls `function(i, tally)` for i in [0, *count); adds what a block counted to the totals of the step.
template <class Function>
struct ForEachTallied
{
    const std::uint32_t* count;
    StepAddresses step;
    Function function;

    /// 128 registers a thread: three blocks, 80 registers, would spill a hundred words a flake in the
    /// advection.
    static constexpr unsigned kThreads = kBlockThreads;
    static constexpr unsigned kLeastResidentBlocks = 2;

    __device__ void operator()() const
    {
        const std::size_t n = *count;
        if (std::size_t{blockIdx.x} * blockDim.x >= n) return;
        __shared__ unsigned ended[BlockTally::kFates];
        __shared__ unsigned lost[BlockTally::kMostEmitters];
        const unsigned emitters = static_cast<unsigned>(step.ledger.count);
        const unsigned t = threadIdx.x;
        if (t < BlockTally::kFates) ended[t] = 0;
        if (t < emitters) lost[t] = 0;
        __syncthreads();
        const BlockTally tally{ended, lost};
        ForEachIndex<Bound>{n, {function, tally}}();
        __syncthreads();
        if (t < emitters && lost[t] > 0) atomicAdd(&step.lost[t], lost[t]);
        StepControl& c = *step.control;
        add(c.left, ended[static_cast<unsigned>(Fate::left)], t == 0);
        add(c.landed, ended[static_cast<unsigned>(Fate::landed)], t == 1);
        add(c.vanished, ended[static_cast<unsigned>(Fate::vanished)], t == 2);
    }

  private:
    struct Bound
    {
        const Function& function;
        const BlockTally& tally;
        __device__ void operator()(std::size_t i) const { function(i, tally); }
    };

    static __device__ void add(unsigned long long& total, unsigned part, bool mine)
    {
        if (mine && part > 0) atomicAdd(&total, static_cast<unsigned long long>(part));
    }
};
static_assert(BlockTally::kMostEmitters <= kBlockThreads, "a thread for each emitter");

template <class Function>
void launch_tallied(StreamRef stream, const char* name, const std::uint32_t* count, const StepAddresses& step,
                    const Function& function)
{
    launch_blocks(stream, name, blocks_for(step.capacity), kBlockThreads,
                  ForEachTallied<Function>{count, step, function});
}

}  // namespace spindrift::gpu
