// SPDX-License-Identifier: MIT
#include "cpu/compaction.h"
#include "core/flake_words.h"
#include "core/kept_order.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "cpu/chunks.h"
#include "cpu/parallel.h"

namespace spindrift::cpu
{

namespace
{

constexpr std::size_t kWord = 64;

void mark_alive(const FlakeView& flakes, std::size_t used, std::uint64_t* alive)
{
    parallel_for_each_index(chunk_count(used),
                            [&](std::size_t c)
                            {
                                const Chunk chunk(c, used);
                                for (std::size_t i = chunk.first; i < chunk.last; i += kWord)
                                {
                                    std::uint64_t bits = 0;
                                    const std::size_t n = std::min(kWord, chunk.last - i);
                                    for (std::size_t j = 0; j < n; ++j)
                                        bits |= std::uint64_t{(flakes.state[i + j] & 0xFFU) == 0U} << j;
                                    alive[i / kWord] = bits;
                                }
                            });
}

/// Moves the marked elements of one array down. The elements are words, whatever they mean.
void close_holes(void* array, const std::uint64_t* alive, std::size_t used)
{
    auto* const bytes = static_cast<unsigned char*>(array);
    std::size_t to = 0;
    for (std::size_t i = 0; i < used; i += kWord)
    {
        std::uint64_t bits = alive[i / kWord];
        if (bits == ~std::uint64_t{0})
        {
            if (to != i) std::memmove(bytes + 4 * to, bytes + 4 * i, 4 * kWord);
            to += kWord;
            continue;
        }
        for (; bits != 0; bits &= bits - 1)
        {
            const std::size_t from = i + static_cast<std::size_t>(std::countr_zero(bits));
            std::memmove(bytes + 4 * to, bytes + 4 * from, 4);
            ++to;
        }
    }
}

}  // namespace

Compactor::Compactor(std::size_t capacity) : alive_((capacity + kWord - 1) / kWord) {}

std::size_t Compactor::operator()(const FlakeView& f, std::size_t used, std::uint32_t* ranks)
{
    mark_alive(f, used, alive_.data());
    const auto arrays = flake_words(f);
    const std::size_t n = arrays.size() + (ranks != nullptr ? 1 : 0);
    parallel_for_each_index(
        n, [&](std::size_t a) { close_holes(a < arrays.size() ? arrays[a] : ranks, alive_.data(), used); });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < used; i += kWord)
        kept += static_cast<std::size_t>(std::popcount(alive_[i / kWord]));
    if (ranks != nullptr) std::fill(ranks + kept, ranks + used, kNoRank);
    return kept;
}

}  // namespace spindrift::cpu
