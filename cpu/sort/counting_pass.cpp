// SPDX-License-Identifier: MIT
#include "cpu/sort/counting_pass.h"

#include <algorithm>
#include <array>
#include <utility>

#include <tbb/task_arena.h>

#include "cpu/parallel.h"

namespace spindrift::cpu
{

namespace
{

constexpr std::size_t kMostChunks = 64;

struct alignas(64) OwnLine  // so that threads do not write to one cache line
{
    std::uint64_t bits = 0;
};

// The loops below are where a sort spends its time. Inlined into a task of TBB they run out of registers.
#define SPINDRIFT_HOT_LOOP __attribute__((noinline))

SPINDRIFT_HOT_LOOP void count_run(const std::uint64_t* first, const std::uint64_t* last, Digit digit,
                                  std::uint32_t* histogram)
{
    std::fill_n(histogram, digit.values(), 0U);
    for (; last - first >= 4; first += 4)
    {
        const std::uint64_t a = first[0], b = first[1], c = first[2], d = first[3];
        ++histogram[digit.of(a)];
        ++histogram[digit.of(b)];
        ++histogram[digit.of(c)];
        ++histogram[digit.of(d)];
    }
    for (; first != last; ++first) ++histogram[digit.of(*first)];
}

// As count_run; returns the bits in which a pair of the run differs from `sample`.
SPINDRIFT_HOT_LOOP std::uint64_t count_run_and_compare(const std::uint64_t* first, const std::uint64_t* last,
                                                       std::uint64_t sample, Digit digit,
                                                       std::uint32_t* histogram)
{
    std::fill_n(histogram, digit.values(), 0U);
    std::uint64_t differing = 0;
    for (; last - first >= 4; first += 4)
    {
        const std::uint64_t a = first[0], b = first[1], c = first[2], d = first[3];
        ++histogram[digit.of(a)];
        ++histogram[digit.of(b)];
        ++histogram[digit.of(c)];
        ++histogram[digit.of(d)];
        differing |= (a ^ sample) | (b ^ sample) | (c ^ sample) | (d ^ sample);
    }
    for (; first != last; ++first)
    {
        ++histogram[digit.of(*first)];
        differing |= *first ^ sample;
    }
    return differing;
}

// A pair goes to the next place of its value. The line after that place is fetched early: without it each
// first store to a line waits for the line, and stores retire in order (2.5x slower on a million pairs, see
// docs/decisions). A prefetch never faults, so it may point past the end.
SPINDRIFT_HOT_LOOP void scatter_run(const std::uint64_t* first, const std::uint64_t* last, std::uint64_t* to,
                                    Digit digit, std::uint32_t* places)
{
    constexpr std::uintptr_t kAhead_bytes = 128;
    const auto put = [=](std::uint64_t pair)
    {
        std::uint64_t* const place = to + places[digit.of(pair)]++;
        *place = pair;
        __builtin_prefetch(
            reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(place) + kAhead_bytes), 1);
    };
    for (; last - first >= 4; first += 4)
    {
        const std::uint64_t a = first[0], b = first[1], c = first[2], d = first[3];
        put(a);
        put(b);
        put(c);
        put(d);
    }
    for (; first != last; ++first) put(*first);
}

// Few values: one thread is quicker than a fork.
void places_in_order(const Chunks& chunks, std::size_t values, std::uint32_t* histograms)
{
    std::uint32_t place = 0;
    for (std::size_t value = 0; value < values; ++value)
        for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
            place += std::exchange(histograms[chunk * values + value], place);
}

void places_in_blocks(const Chunks& chunks, std::size_t values, std::uint32_t* histograms)
{
    constexpr std::size_t kBlocks = 64;
    const std::size_t block_values = values / kBlocks;
    std::array<std::uint32_t, kBlocks> starts{};
    parallel_for_each_index(kBlocks,
                            [&](std::size_t block)
                            {
                                std::uint32_t sum = 0;
                                for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
                                {
                                    const auto* counts = histograms + chunk * values + block * block_values;
                                    for (std::size_t i = 0; i < block_values; ++i) sum += counts[i];
                                }
                                starts[block] = sum;
                            });
    std::uint32_t start = 0;
    for (std::uint32_t& block_start : starts) start += std::exchange(block_start, start);
    parallel_for_each_index(kBlocks,
                            [&](std::size_t block)
                            {
                                std::uint32_t place = starts[block];
                                for (std::size_t i = 0; i < block_values; ++i)
                                    for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
                                    {
                                        auto& count = histograms[chunk * values + block * block_values + i];
                                        place += std::exchange(count, place);
                                    }
                            });
}

}  // namespace

Chunks::Chunks(std::size_t n, std::size_t shortest, std::size_t most)
    : n_(n),
      count_(std::clamp<std::size_t>(
          std::min(n / shortest, static_cast<std::size_t>(tbb::this_task_arena::max_concurrency())), 1,
          std::min(most, kMostChunks)))
{
}

void count_digit(const std::uint64_t* pairs, const Chunks& chunks, Digit digit, std::uint32_t* histograms)
{
    parallel_for_each_index(chunks.count(),
                            [&](std::size_t chunk)
                            {
                                count_run(pairs + chunks.begin(chunk), pairs + chunks.end(chunk), digit,
                                          histograms + chunk * digit.values());
                            });
}

std::uint64_t count_digit_and_compare(const std::uint64_t* pairs, const Chunks& chunks, Digit digit,
                                      std::uint32_t* histograms)
{
    std::array<OwnLine, kMostChunks> differing{};
    const std::uint64_t sample = pairs[0];
    parallel_for_each_index(chunks.count(),
                            [&](std::size_t chunk)
                            {
                                differing[chunk].bits = count_run_and_compare(
                                    pairs + chunks.begin(chunk), pairs + chunks.end(chunk), sample, digit,
                                    histograms + chunk * digit.values());
                            });
    std::uint64_t all = 0;
    for (const OwnLine& line : differing) all |= line.bits;
    return all;
}

void counts_to_places(const Chunks& chunks, Digit digit, std::uint32_t* histograms)
{
    constexpr std::size_t kWorthForking = 32768;
    if (chunks.count() * digit.values() < kWorthForking)
        places_in_order(chunks, digit.values(), histograms);
    else
        places_in_blocks(chunks, digit.values(), histograms);
}

void scatter_by_digit(const std::uint64_t* from, std::uint64_t* to, const Chunks& chunks, Digit digit,
                      std::uint32_t* places)
{
    parallel_for_each_index(chunks.count(),
                            [&](std::size_t chunk)
                            {
                                scatter_run(from + chunks.begin(chunk), from + chunks.end(chunk), to, digit,
                                            places + chunk * digit.values());
                            });
}

}  // namespace spindrift::cpu
