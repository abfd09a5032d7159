// SPDX-License-Identifier: MIT
#include <cstdlib>

#include "cpu/sort/strategy.h"

namespace spindrift::cpu::sorts
{

namespace
{

int compare_pairs(const void* a, const void* b)
{
    const std::uint64_t left = *static_cast<const std::uint64_t*>(a);
    const std::uint64_t right = *static_cast<const std::uint64_t*>(b);
    return int{left > right} - int{left < right};
}

std::uint64_t* sort(const SortJob& job)
{
    if (job.n > 1) std::qsort(job.pairs, job.n, sizeof(std::uint64_t), compare_pairs);
    return job.pairs;
}

}  // namespace

SortStrategy libc_qsort()
{
    return {.name = "qsort",
            .about = "the C library's qsort, one thread: the quick sort that the field reports",
            .sort = sort,
            .max_key_bits = 32,
            .bytes_moved_per_pair_32 = 0};
}

}  // namespace spindrift::cpu::sorts
