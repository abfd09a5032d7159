// SPDX-License-Identifier: MIT
#include "cpu/sort/strategy.h"

#include <algorithm>
#include <array>

// The table: a line here and a file of that name that defines SortStrategy sorts::NAME().
#define SPINDRIFT_SORTS(ROW) \
    ROW(none)                \
    ROW(libc_qsort)          \
    ROW(std_sort)            \
    ROW(std_parallel)        \
    ROW(radix)               \
    ROW(counting16)          \
    ROW(vqsort)              \
    ROW(block_indirect)      \
    ROW(bitonic_passes)      \
    ROW(odd_even_passes)

namespace spindrift::cpu
{

namespace sorts
{
#define SPINDRIFT_DECLARE(name) SortStrategy name();
SPINDRIFT_SORTS(SPINDRIFT_DECLARE)
#undef SPINDRIFT_DECLARE
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
    if (name == "auto") name = "radix";
    if (name == "passes") name = "bitonic-passes";
    const auto table = sort_strategies();
    const auto row = std::ranges::find(table, name, &SortStrategy::name);
    return row == table.end() ? nullptr : &*row;
}

}  // namespace spindrift::cpu
