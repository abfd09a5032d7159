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

// A digit whose shift the compiler knows. By a variable, the shift that every x86-64 has takes an Intel core
// two or three operations instead of one.
template <int Shift>
struct DigitAt
{
    std::uint64_t mask;

    std::uint64_t of(std::uint64_t pair) const { return (pair >> Shift) & mask; }
};

// Calls loop(digit), with the shift known where it is one of those for whole keys of 32, 24 and 16 bits.
template <class Loop>
void with_known_shift(Digit digit, const Loop& loop)
{
    switch (digit.shift)
    {
        case 32:
            return loop(DigitAt<32>{digit.mask()});
        case 40:
            return loop(DigitAt<40>{digit.mask()});
        case 43:
            return loop(DigitAt<43>{digit.mask()});
        case 44:
            return loop(DigitAt<44>{digit.mask()});
        case 54:
            return loop(DigitAt<54>{digit.mask()});
        default:
            return loop(digit);
    }
}

template <class AnyDigit>
SPINDRIFT_HOT_LOOP void count_run(const std::uint64_t* first, const std::uint64_t* last, AnyDigit digit,
                                  std::uint32_t* histogram)
{
    // What fetches ahead by itself is too late for this loop. A prefetch never faults.
    constexpr std::uintptr_t kAhead_bytes = 1024;
    for (; last - first >= 8; first += 8)
    {
        __builtin_prefetch(
            reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(first) + kAhead_bytes));
        for (int i = 0; i < 8; ++i) ++histogram[digit.of(first[i])];
    }
    for (; first != last; ++first) ++histogram[digit.of(*first)];
}

// A pair goes to the next place of its value. Places are taken kAhead pairs before they are written, and
// their lines fetched meanwhile: stores retire in order, so each store to a line that is not there would hold
// up all that follow. Two places share a word of the queue: one store less for each pair.
template <class AnyDigit>
SPINDRIFT_HOT_LOOP void scatter_run(const std::uint64_t* first, const std::uint64_t* last, std::uint64_t* to,
                                    AnyDigit digit, std::uint32_t* places)
{
    constexpr std::size_t kAhead = 64;
    std::array<std::uint64_t, kAhead / 2> queue;
    const auto place_of = [=](std::uint64_t pair)
    {
        const std::uint64_t place = places[digit.of(pair)]++;
        __builtin_prefetch(to + place, 1);
        return place;
    };
    const auto take_two = [&](std::size_t i)
    {
        const std::uint64_t place = place_of(first[i]);
        queue[i / 2 % queue.size()] = place | place_of(first[i + 1]) << 32;
    };
    const auto put_two = [&](std::size_t i)
    {
        const std::uint64_t two = queue[i / 2 % queue.size()];
        to[static_cast<std::uint32_t>(two)] = first[i];
        to[two >> 32] = first[i + 1];
    };
    const auto n = static_cast<std::size_t>(last - first);
    const std::size_t even = n / 2 * 2;
    const std::size_t ahead = std::min(even, kAhead);
    for (std::size_t i = 0; i < ahead; i += 2) take_two(i);
    for (std::size_t i = ahead; i < even; i += 2)
    {
        put_two(i - ahead);
        take_two(i);
    }
    for (std::size_t i = even - ahead; i < even; i += 2) put_two(i);
    if (even != n) to[place_of(first[even])] = first[even];
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

Chunks::Chunks(std::size_t n, const ChunkLimits& limits) : n_(n)
{
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    const std::size_t for_each_thread = std::min(n / (threads * limits.shortest), limits.per_thread);
    const std::size_t wanted = for_each_thread > 0 ? for_each_thread * threads : n / limits.shortest;
    count_ = std::clamp<std::size_t>(wanted, 1, std::min(limits.most, kMostChunks));
}

void count_digit(const std::uint64_t* pairs, const Chunks& chunks, Digit digit, std::uint32_t* histograms)
{
    parallel_for_each_index(
        chunks.count(),
        [&](std::size_t chunk)
        {
            std::uint32_t* const counts = histograms + chunk * digit.values();
            std::fill_n(counts, digit.values(), 0U);
            with_known_shift(
                digit, [&](auto known)
                { count_run(pairs + chunks.begin(chunk), pairs + chunks.end(chunk), known, counts); });
        });
}

std::uint64_t differing_bits(const std::uint64_t* pairs, const Chunks& chunks)
{
    std::array<OwnLine, kMostChunks> differing{};
    const std::uint64_t sample = pairs[0];
    parallel_for_each_index(chunks.count(),
                            [&](std::size_t chunk)
                            {
                                std::uint64_t bits = 0;
                                for (std::size_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i)
                                    bits |= pairs[i] ^ sample;
                                differing[chunk].bits = bits;
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
                                with_known_shift(digit,
                                                 [&](auto known)
                                                 {
                                                     scatter_run(from + chunks.begin(chunk),
                                                                 from + chunks.end(chunk), to, known,
                                                                 places + chunk * digit.values());
                                                 });
                            });
}

}  // namespace spindrift::cpu
