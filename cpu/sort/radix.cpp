// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "cpu/sort/counting_pass.h"
#include "cpu/sort/histogram_pool.h"
#include "cpu/sort/strategy.h"

// Least significant digit first: each pass keeps the order that the passes before it made, so the whole is
// stable. The choice of digits is measured in docs/decisions/004-radix-sort.md.

namespace spindrift::cpu::sorts
{

namespace
{

constexpr int kKeyShift = 32;
// Threads that write into one line of output wait for each other; shorter chunks share too many.
constexpr ChunkLimits kChunks{.shortest = 65536, .per_thread = 4, .most = 64};

/// The passes over the span of key bits that are set in `differing`: as few as the widest digit allows, of
/// even width; at least one.
class Plan
{
  public:
    Plan(std::uint32_t differing, int widest)
    {
        differing = std::max(differing, 1U);
        const int low = std::countr_zero(differing);
        const int high = 32 - std::countl_zero(differing);
        count_ = (high - low + widest - 1) / widest;
        for (int pass = 0, at = low; pass < count_; ++pass)
        {
            const int passes_left = count_ - pass;
            const int bits = (high - at + passes_left - 1) / passes_left;
            digits_[static_cast<std::size_t>(pass)] = {.shift = kKeyShift + at, .bits = bits};
            at += bits;
        }
    }

    std::size_t count() const { return static_cast<std::size_t>(count_); }
    Digit operator[](std::size_t pass) const { return digits_[pass]; }

  private:
    std::array<Digit, 4> digits_{};  // widest >= 8
    int count_ = 0;
};

// Wide digits save passes, unless the counters cost more than the pairs.
int widest_digit_bits(std::size_t n)
{
    constexpr std::size_t kFewPairs = 4096;
    return n < kFewPairs ? 8 : 12;
}

std::uint32_t differing_bits_of_some(const SortJob& job)
{
    constexpr std::size_t kSome = 64;
    std::uint64_t differing = 0;
    for (std::size_t i = 0; i < kSome; ++i) differing |= job.pairs[i * (job.n / kSome)] ^ job.pairs[0];
    return static_cast<std::uint32_t>(differing >> kKeyShift);
}

void insertion_sort(std::uint64_t* pairs, std::size_t n)
{
    for (std::size_t i = 1; i < n; ++i)
    {
        const std::uint64_t pair = pairs[i];
        std::size_t at = i;
        for (; at > 0 && (pairs[at - 1] >> kKeyShift) > (pair >> kKeyShift); --at) pairs[at] = pairs[at - 1];
        pairs[at] = pair;
    }
}

bool all_in_one_value(const Chunks& chunks, Digit digit, const std::uint32_t* histograms, std::uint64_t pair,
                      std::size_t n)
{
    std::size_t count = 0;
    for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
        count += histograms[chunk * digit.values() + digit.of(pair)];
    return count == n;
}

std::uint64_t* sort(const SortJob& job)
{
    constexpr std::size_t kTiny = 64;
    if (job.n < kTiny)
    {
        insertion_sort(job.pairs, job.n);
        return job.pairs;
    }
    const Chunks chunks(job.n, kChunks);
    const int widest = widest_digit_bits(job.n);
    const HistogramLease lease(chunks.count() << widest);

    // Bits in which no key differs need no pass. A few keys say whether looking at all of them could save
    // one.
    const std::uint32_t all_bits = ~0U >> (32 - job.key_bits);
    Plan plan(all_bits, widest);
    if (Plan(differing_bits_of_some(job), widest).count() < plan.count())
    {
        const auto differing = static_cast<std::uint32_t>(differing_bits(job.pairs, chunks) >> kKeyShift);
        if (differing == 0) return job.pairs;
        plan = Plan(differing, widest);
    }

    std::uint64_t* from = job.pairs;
    std::uint64_t* to = job.scratch;
    for (std::size_t pass = 0; pass < plan.count(); ++pass)
    {
        const Digit digit = plan[pass];
        count_digit(from, chunks, digit, lease.counters());
        if (all_in_one_value(chunks, digit, lease.counters(), from[0], job.n)) continue;
        counts_to_places(chunks, digit, lease.counters());
        scatter_by_digit(from, to, chunks, digit, lease.counters());
        std::swap(from, to);
    }
    return from;
}

}  // namespace

SortStrategy radix()
{
    return {
        .name = "radix",
        .about = "our own stable radix sort, least significant digit first, all threads",
        .sort = sort,
        .max_key_bits = 32,
        .bytes_moved_per_pair_32 = 8 + 3 * 16};  // one read to count, then three passes that read and write
}

}  // namespace spindrift::cpu::sorts
