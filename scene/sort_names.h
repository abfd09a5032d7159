// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

namespace spindrift::scene
{

/// Sort strategies that a scene or a command line may name. A backend says again, when asked, whether it has
/// the strategy.
inline constexpr std::array<std::string_view, 8> kSortNames{
    "none", "qsort", "std", "std-par", "radix", "counting16", "vqsort", "block-indirect"};

}  // namespace spindrift::scene
