// SPDX-License-Identifier: MIT
#include "scene/nearest_name.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace spindrift::scene
{
namespace
{

/// Optimal string alignment distance, by three rows of its table.
std::size_t edits_between(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

}  // namespace

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known)
{
    constexpr std::size_t kLongestName = 64;  // no key is that long; keeps the table small for hostile input
    if (name.size() > kLongestName) return {};
    const std::size_t limit = std::max<std::size_t>(1, (name.size() + 1) / 3);
    std::string_view nearest;
    std::size_t fewest = limit + 1;
    for (const std::string_view candidate : known)
    {
        const std::size_t edits = edits_between(name, candidate);
        if (edits >= fewest || edits >= candidate.size()) continue;
        fewest = edits;
        nearest = candidate;
    }
    return nearest;
}

std::string listed(std::span<const std::string_view> names)
{
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        if (i > 0) list += i + 1 == names.size() ? " or " : ", ";
        list += names[i];
    }
    return list;
}

}  // namespace spindrift::scene
