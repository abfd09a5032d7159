// SPDX-License-Identifier: MIT
#include <tbb/task_arena.h>
#include <boost/sort/block_indirect_sort/block_indirect_sort.hpp>

#include "cpu/sort/strategy.h"

namespace spindrift::cpu::sorts
{

namespace
{

// Starts its own threads at each call, as many as the current arena has.
std::uint64_t* sort(const SortJob& job)
{
    const auto threads = static_cast<std::uint32_t>(tbb::this_task_arena::max_concurrency());
    boost::sort::block_indirect_sort(job.pairs, job.pairs + job.n, threads);
    return job.pairs;
}

}  // namespace

SortStrategy block_indirect()
{
    return {.name = "block-indirect",
            .about = "Boost's block_indirect_sort over all threads",
            .sort = sort,
            .max_key_bits = 32,
            .bytes_moved_per_pair_32 = 0};
}

}  // namespace spindrift::cpu::sorts
