// SPDX-License-Identifier: MIT
#include <algorithm>

#include "cpu/sort/strategy.h"

namespace spindrift::cpu::sorts
{

namespace
{

std::uint64_t* sort(const SortJob& job)
{
    std::sort(job.pairs, job.pairs + job.n);
    return job.pairs;
}

}  // namespace

SortStrategy std_sort()
{
    return {.name = "std",
            .about = "std::sort, one thread",
            .sort = sort,
            .max_key_bits = 32,
            .bytes_moved_per_pair_32 = 0};
}

}  // namespace spindrift::cpu::sorts
