// SPDX-License-Identifier: MIT
#include "cpu/reorder.h"

#include <algorithm>
#include <cstring>

#include "core/emission_order.h"
#include "core/flake_words.h"
#include "core/kept_order.h"
#include "core/visible.h"
#include "cpu/chunks.h"
#include "cpu/parallel.h"
#include "cpu/sort/strategy.h"

namespace spindrift::cpu
{

namespace
{

template <class Body>
void for_each_chunk(std::size_t n, const Body& body)
{
    parallel_for_each_index(chunk_count(n), [&](std::size_t c) { body(Chunk(c, n)); });
}

/// Element i becomes what element (low half of sorted[i]) was.
void move_words(std::uint32_t* array, const std::uint64_t* sorted, std::size_t n, std::uint32_t* by_way_of)
{
    auto* const bytes = reinterpret_cast<unsigned char*>(array);
    auto* const away = reinterpret_cast<unsigned char*>(by_way_of);
    for_each_chunk(n,
                   [&](const Chunk& chunk)
                   {
                       for (std::size_t i = chunk.first; i < chunk.last; ++i)
                           std::memcpy(away + 4 * i, bytes + 4 * static_cast<std::uint32_t>(sorted[i]), 4);
                   });
    for_each_chunk(
        n, [&](const Chunk& chunk)
        { std::memcpy(bytes + 4 * chunk.first, away + 4 * chunk.first, 4 * (chunk.last - chunk.first)); });
}

}  // namespace

void reorder_by_cell(const CellOrder& order, std::size_t used, std::size_t alive, const DrawListView& list,
                     std::uint32_t* ranks)
{
    static const SortStrategy& radix = *find_sort_strategy("radix");
    for_each_chunk(used,
                   [&](const Chunk& chunk)
                   {
                       for (std::size_t i = chunk.first; i < chunk.last; ++i)
                           list.pairs[i] = draw_list_pair(order(i), i);
                   });
    const std::uint64_t* const sorted = radix.sort({list.pairs, list.scratch, used, order.key_bits()});
    std::uint64_t* const rest = sorted == list.pairs ? list.scratch : list.pairs;
    for (std::uint32_t* const array : flake_words(order.flakes))
        move_words(array, sorted, alive, reinterpret_cast<std::uint32_t*>(rest));
    if (ranks == nullptr) return;
    move_words(ranks, sorted, alive, reinterpret_cast<std::uint32_t*>(rest));
    std::fill(ranks + alive, ranks + used, kNoRank);
}

void order_ties(std::uint64_t* pairs, std::size_t n, const std::uint32_t* id, std::uint32_t next_id)
{
    const EmissionOrder order{pairs, n, id, next_id};
    for_each_chunk(n,
                   [&](const Chunk& chunk)
                   {
                       for (std::size_t i = chunk.first; i < chunk.last; ++i) order(i);
                   });
}

}  // namespace spindrift::cpu
