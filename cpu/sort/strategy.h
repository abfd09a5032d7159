// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/sort_network.h"

namespace spindrift::cpu
{

/// One sort of (depth key << 32 | slot) pairs, ascending.
struct SortJob
{
    std::uint64_t* pairs;    ///< n elements, in ascending slot order on entry
    std::uint64_t* scratch;  ///< n elements
    std::size_t n;
    int key_bits;  ///< keys are < 2^key_bits: 32, 24 or 16
};

/// A row of the table. Equal keys keep ascending slot order (which is id order), so every exact strategy
/// gives the same permutation.
struct SortStrategy
{
    std::string_view name;
    std::string_view about;  ///< one line for --help
    /// Returns where the sorted pairs are: job.pairs or job.scratch. Null for "none" and those with a
    /// network.
    std::uint64_t* (*sort)(const SortJob& job);
    int max_key_bits;             ///< most key bits that it can use: the key maker narrows the keys to it
    int bytes_moved_per_pair_32;  ///< the traffic of its passes at 32 key bits, 0 if it depends on the data
    /// Set: it sorts over frames, by PassSorter, and is not exact.
    std::optional<Network> network = {};
};

/// The table; order is the order of --help and of the key that steps through strategies.
std::span<const SortStrategy> sort_strategies();

/// Null if there is none of that name. "auto" is the exact one that suits most, "passes" is short for
/// "bitonic-passes".
const SortStrategy* find_sort_strategy(std::string_view name);

}  // namespace spindrift::cpu
