// SPDX-License-Identifier: MIT
#include "cpu/sort/passes.h"

#include <algorithm>
#include <span>

#include "cpu/parallel.h"

namespace spindrift::cpu
{

namespace
{

constexpr std::size_t kChunk = 16384;
constexpr std::size_t kTile = kNetworkTile;           // several steps while the pairs lie in the first cache
constexpr std::uint64_t kNoPair = ~std::uint64_t{0};  // no slot has this number

std::size_t chunks_of(std::size_t n)
{
    return (n + kChunk - 1) / kChunk;
}
std::size_t end_of(std::size_t chunk, std::size_t n)
{
    return std::min(n, (chunk + 1) * kChunk);
}
std::uint32_t slot_of(std::uint64_t pair)
{
    return static_cast<std::uint32_t>(pair);
}

template <class T>
void fill(T* values, std::size_t n, T value)
{
    parallel_for_each_index(
        chunks_of(n), [=](std::size_t c) { std::fill(values + c * kChunk, values + end_of(c, n), value); });
}

/// Moves the pairs of [first, last) that `wanted` picks to the front; returns how many.
template <class Wanted>
std::size_t close_up(std::uint64_t* first, std::uint64_t* last, const Wanted& wanted)
{
    return static_cast<std::size_t>(
        std::remove_if(first, last, [&](std::uint64_t pair) { return !wanted(pair); }) - first);
}

/// Counts to starts, in place; returns the sum.
std::size_t counts_to_starts(std::span<std::size_t> counts, std::size_t from)
{
    for (std::size_t& count : counts)
    {
        const std::size_t n = count;
        count = from;
        from += n;
    }
    return from;
}

void run_comparators(std::uint64_t* pairs, const NetworkStep& step, std::size_t first, std::size_t last)
{
    for (std::size_t c = first; c < last; ++c)
    {
        const std::size_t upper = step.upper(c);
        const std::size_t lower = step.lower(upper);
        const std::uint64_t a = pairs[lower], b = pairs[upper];
        pairs[lower] = std::min(a, b);
        pairs[upper] = std::max(a, b);
    }
}

void run_in_tiles(std::uint64_t* pairs, std::size_t n, std::span<const NetworkStep> steps)
{
    parallel_for_each_index((n + kTile - 1) / kTile,
                            [=](std::size_t tile)
                            {
                                const std::size_t first = tile * kTile;
                                const std::size_t size = std::min(n - first, kTile);
                                for (const NetworkStep& step : steps)
                                    run_comparators(pairs + first, step, 0, step.comparators(size));
                            });
}

void run_across(std::uint64_t* pairs, std::size_t n, const NetworkStep& step)
{
    const std::size_t comparators = step.comparators(n);
    parallel_for_each_index(chunks_of(comparators), [=](std::size_t c)
                            { run_comparators(pairs, step, c * kChunk, end_of(c, comparators)); });
}

}  // namespace

PassSorter::PassSorter(Network network, std::size_t slots)
    : network_(network),
      walk_(network),
      rank_(slots, kNoRank),
      places_(slots),
      kept_starts_(chunks_of(slots)),
      new_starts_(chunks_of(slots))
{
}

std::uint64_t* PassSorter::sort(const SortJob& job, int passes, SortStart start)
{
    std::uint64_t* pairs = nullptr;
    if (start == SortStart::exact)
    {
        walk_ = NetworkWalk(network_);
        pairs = find_sort_strategy("radix")->sort(job);
    }
    else
    {
        pairs = in_kept_order(job);
        run_steps(pairs, job.n, passes);
    }
    keep_order(pairs, job.n);
    return pairs;
}

// Both lists keep their order: those with a place by place, the new ones by slot.
std::uint64_t* PassSorter::in_kept_order(const SortJob& job)
{
    const auto is_new = [this](std::uint64_t pair) { return rank_[slot_of(pair)] == kNoRank; };
    fill(places_.data(), kept_, kNoPair);
    parallel_for_each_index(chunks_of(job.n),
                            [&](std::size_t c)
                            {
                                std::uint64_t* const first = job.pairs + c * kChunk;
                                std::uint64_t* const last = job.pairs + end_of(c, job.n);
                                for (const std::uint64_t* pair = first; pair != last; ++pair)
                                    if (!is_new(*pair)) places_[rank_[slot_of(*pair)]] = *pair;
                                new_starts_[c] = close_up(first, last, is_new);
                            });
    parallel_for_each_index(chunks_of(kept_),
                            [&](std::size_t c)
                            {
                                kept_starts_[c] =
                                    close_up(places_.data() + c * kChunk, places_.data() + end_of(c, kept_),
                                             [](std::uint64_t pair) { return pair != kNoPair; });
                            });
    const std::span kept = std::span(kept_starts_).first(chunks_of(kept_));
    const std::span added = std::span(new_starts_).first(chunks_of(job.n));
    const std::size_t still_there = counts_to_starts(kept, 0);
    counts_to_starts(added, still_there);
    const auto gather = [&](std::span<const std::size_t> starts, const std::uint64_t* from, std::size_t end)
    {
        parallel_for_each_index(starts.size(),
                                [&](std::size_t c)
                                {
                                    const std::size_t next = c + 1 < starts.size() ? starts[c + 1] : end;
                                    std::copy_n(from + c * kChunk, next - starts[c], job.scratch + starts[c]);
                                });
    };
    gather(kept, places_.data(), still_there);
    gather(added, job.pairs, job.n);
    return job.scratch;
}

void PassSorter::run_steps(std::uint64_t* pairs, std::size_t n, int passes)
{
    constexpr std::size_t kMost = 32;
    if (n < 2) return;
    NetworkStep in_tiles[kMost];
    std::size_t waiting = 0;
    const auto run_waiting = [&]
    {
        if (waiting > 0) run_in_tiles(pairs, n, std::span(in_tiles, waiting));
        waiting = 0;
    };
    for (int pass = 0; pass < passes; ++pass)
    {
        const NetworkStep step = walk_.next(n);
        if (step.stays_in_tiles_of(kTile))
        {
            if (waiting == kMost) run_waiting();
            in_tiles[waiting++] = step;
            continue;
        }
        run_waiting();
        run_across(pairs, n, step);
    }
    run_waiting();
}

void PassSorter::keep_order(const std::uint64_t* pairs, std::size_t n)
{
    fill(rank_.data(), rank_.size(), kNoRank);
    parallel_for_each_index(chunks_of(n),
                            [=, this](std::size_t c)
                            {
                                for (std::size_t i = c * kChunk; i < end_of(c, n); ++i)
                                    rank_[slot_of(pairs[i])] = static_cast<std::uint32_t>(i);
                            });
    kept_ = n;
}

namespace sorts
{

SortStrategy bitonic_passes()
{
    return {.name = "bitonic-passes",
            .about = "some steps of a bitonic network a frame on the order of the last frame; not exact",
            .sort = nullptr,
            .max_key_bits = 32,
            .bytes_moved_per_pair_32 = 0,
            .network = Network::bitonic};
}

SortStrategy odd_even_passes()
{
    return {.name = "odd-even-passes",
            .about = "the same with steps that compare neighbours: for keys that change little; not exact",
            .sort = nullptr,
            .max_key_bits = 32,
            .bytes_moved_per_pair_32 = 0,
            .network = Network::odd_even};
}

}  // namespace sorts

}  // namespace spindrift::cpu
