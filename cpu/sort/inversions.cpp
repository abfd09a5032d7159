// SPDX-License-Identifier: MIT
#include "cpu/sort/inversions.h"

#include <algorithm>

namespace spindrift::cpu
{

namespace
{

// Bottom-up merge sort: what is taken from the right run passes all that is left of the left one.
template <class T>
double fraction(std::vector<T> from)
{
    const std::size_t n = from.size();
    if (n < 2) return 0;
    std::vector<T> to(n);
    std::uint64_t inversions = 0;
    for (std::size_t run = 1; run < n; run *= 2)
    {
        for (std::size_t begin = 0; begin < n; begin += 2 * run)
        {
            const std::size_t middle = std::min(begin + run, n), end = std::min(begin + 2 * run, n);
            std::size_t left = begin, right = middle;
            for (std::size_t i = begin; i < end; ++i)
            {
                const bool take_right = left == middle || (right < end && from[right] < from[left]);
                if (take_right) inversions += middle - left;
                to[i] = take_right ? from[right++] : from[left++];
            }
        }
        std::swap(from, to);
    }
    const double couples = 0.5 * static_cast<double>(n) * static_cast<double>(n - 1);
    return static_cast<double>(inversions) / couples;
}

}  // namespace

double inversion_fraction(std::span<const std::uint64_t> pairs)
{
    return fraction(std::vector<std::uint64_t>(pairs.begin(), pairs.end()));
}

double inversion_fraction(std::span<const std::uint64_t> pairs, std::span<const std::uint64_t> exact,
                          std::size_t slots)
{
    std::vector<std::uint32_t> rank(slots);
    for (std::size_t i = 0; i < exact.size(); ++i)
        rank[static_cast<std::uint32_t>(exact[i])] = static_cast<std::uint32_t>(i);
    std::vector<std::uint32_t> places;
    places.reserve(pairs.size());
    for (const std::uint64_t pair : pairs) places.push_back(rank[static_cast<std::uint32_t>(pair)]);
    return fraction(std::move(places));
}

}  // namespace spindrift::cpu
