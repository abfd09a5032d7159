// SPDX-License-Identifier: MIT
#include "cuda/sort/strategy.h"

#include <algorithm>
#include <array>

// The table: a line here and a function SortStrategy sorts::NAME() in a file of its own.
#define SPINDRIFT_SORTS(ROW) \
    ROW(none)                \
    ROW(cub_radix)           \
    ROW(thrust_sort)         \
    ROW(cub_merge)           \
    ROW(bitonic)             \
    ROW(bucket16)            \
    ROW(bitonic_passes)      \
    ROW(odd_even_passes)

namespace spindrift::gpu
{

namespace sorts
{
#define SPINDRIFT_DECLARE(name) SortStrategy name();
SPINDRIFT_SORTS(SPINDRIFT_DECLARE)
#undef SPINDRIFT_DECLARE

SortStrategy none()
{
    return {.name = "none",
            .about = "no sort: flakes are drawn in the order of their emission",
            .make = nullptr,
            .max_key_bits = 32,
            .bytes_per_pair = [](std::size_t, int, int) { return 0.0; }};
}
}  // namespace sorts

std::span<const SortStrategy> sort_strategies()
{
#define SPINDRIFT_CALL(name) sorts::name(),
    static const std::array table{SPINDRIFT_SORTS(SPINDRIFT_CALL)};
#undef SPINDRIFT_CALL
    return table;
}

const SortStrategy* find_sort_strategy(std::string_view name)
{
    if (name == "auto") name = "cub-radix";
    if (name == "passes") name = "bitonic-passes";
    const auto table = sort_strategies();
    const auto row = std::ranges::find(table, name, &SortStrategy::name);
    return row == table.end() ? nullptr : &*row;
}

}  // namespace spindrift::gpu
