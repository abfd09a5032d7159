// SPDX-License-Identifier: MIT
#include <hwy/contrib/sort/vqsort.h>

#include "cpu/sort/strategy.h"

namespace spindrift::cpu::sorts
{

namespace
{

std::uint64_t* sort(const SortJob& job)
{
    // Owns the working memory of the sort, so one for each thread that calls; made once.
    static thread_local const hwy::Sorter sorter;
    if (job.n > 1) sorter(job.pairs, job.n, hwy::SortAscending{});
    return job.pairs;
}

}  // namespace

SortStrategy vqsort()
{
    return {.name = "vqsort",
            .about = "Highway's vectorised quick sort on whole pairs, one thread",
            .sort = sort,
            .max_key_bits = 32,
            .bytes_moved_per_pair_32 = 0};
}

}  // namespace spindrift::cpu::sorts
