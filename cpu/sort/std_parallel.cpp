// SPDX-License-Identifier: MIT
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include "cpu/sort/strategy.h"

namespace spindrift::cpu::sorts
{

namespace
{

// std::sort(std::execution::par) of libstdc++ runs on TBB too and measured 10 % slower on a million pairs.
std::uint64_t* sort(const SortJob& job)
{
    const auto run = [&job] { tbb::parallel_sort(job.pairs, job.pairs + job.n); };
#if defined(__SANITIZE_THREAD__)
    // Debian's libtbb is not instrumented: ThreadSanitizer would report the order that its fork and join
    // give.
    tbb::task_arena one_thread(1);
    one_thread.execute(run);
#else
    run();
#endif
    return job.pairs;
}

}  // namespace

SortStrategy std_parallel()
{
    return {.name = "std-par",
            .about = "tbb::parallel_sort: std::sort over all threads",
            .sort = sort,
            .max_key_bits = 32,
            .bytes_moved_per_pair_32 = 0};
}

}  // namespace spindrift::cpu::sorts
