// SPDX-License-Identifier: MIT
#include "cpu/sort/counting_pass.h"
#include "cpu/sort/histogram_pool.h"
#include "cpu/sort/strategy.h"

namespace spindrift::cpu::sorts
{

namespace
{

constexpr Digit kWholeKey{.shift = 32, .bits = 16};
// A shorter chunk spends its time on its 65 536 counters, which are 256 KiB.
constexpr ChunkLimits kChunks{.shortest = 65536, .per_thread = 1, .most = 16};

std::uint64_t* sort(const SortJob& job)
{
    if (job.n < 2) return job.pairs;
    const Chunks chunks(job.n, kChunks);
    const HistogramLease lease(chunks.count() * kWholeKey.values());
    count_digit(job.pairs, chunks, kWholeKey, lease.counters());
    counts_to_places(chunks, kWholeKey, lease.counters());
    scatter_by_digit(job.pairs, job.scratch, chunks, kWholeKey, lease.counters());
    return job.scratch;
}

}  // namespace

SortStrategy counting16()
{
    return {.name = "counting16",
            .about = "one counting pass over 16-bit depth keys, all threads",
            .sort = sort,
            .max_key_bits = 16,
            .bytes_moved_per_pair_32 = 24};  // read to count, read and write to move
}

}  // namespace spindrift::cpu::sorts
