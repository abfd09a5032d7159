// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/sort_study.h"

namespace spindrift::app
{

/// For people: a block for each input and size.
std::string to_text(std::span<const SortRow> rows);
std::string to_csv(std::span<const SortRow> rows);
/// With the machine beside the rows.
std::string to_json(std::span<const SortRow> rows, const std::string& pictures_by);

/// Sizes of the report's Table 4.1 (seconds to sort) and the sorts of ours that stand beside it.
inline constexpr std::array<std::size_t, 6> kTable41Sizes{15'000,  65'000,    250'000,
                                                          500'000, 1'000'000, 2'000'000};
std::vector<std::string> table_4_1_strategies();
/// The report's table beside rows of random keys at these sizes, as Markdown. Sorts without rows have no
/// column.
std::string table_4_1(std::span<const SortRow> rows);

}  // namespace spindrift::app
