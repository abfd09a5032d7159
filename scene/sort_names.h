// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

namespace spindrift::scene
{

/// Sort strategies that a scene or a command line may name: those of any backend. `auto` is the exact sort
/// that the backend at hand takes for general use, `passes` is short for bitonic-passes. A backend that has
/// not got the one that is named says so; it never takes another.
inline constexpr std::array<std::string_view, 17> kSortNames{
    "auto",       "none",   "qsort",          "std",     "std-par",        "radix",
    "counting16", "vqsort", "block-indirect", "passes",  "bitonic-passes", "odd-even-passes",
    "cub-radix",  "thrust", "cub-merge",      "bitonic", "bucket16"};

}  // namespace spindrift::scene
