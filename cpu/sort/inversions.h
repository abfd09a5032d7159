// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace spindrift::cpu
{

/// The share of all couples of elements that stand in the wrong order: 0 sorted, 1/2 random, 1 reversed.
double inversion_fraction(std::span<const std::uint64_t> pairs);

/// The same for places 0, 1, 2 … of slots: `pairs` against the order of `exact`, whose keys may be others.
/// Both hold the same slots, each once, all less than `slots`.
double inversion_fraction(std::span<const std::uint64_t> pairs, std::span<const std::uint64_t> exact,
                          std::size_t slots);

}  // namespace spindrift::cpu
