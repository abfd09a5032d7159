// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/poisson.h"
#include "cpu/parallel.h"

namespace spindrift::cpu
{

/// Calls body(first, y, z) for every row of cells along x, on the threads of the current arena; `first` is
/// the index of the row's first cell.
template <class Body>
void for_each_row(const PaddedBox& box, const Body& body)
{
    const RowChunks chunks(box);
    const auto ny = static_cast<std::uint32_t>(box.ny);
    parallel_for_each_index(chunks.count,
                            [&](std::size_t c)
                            {
                                const auto chunk = static_cast<std::uint32_t>(c);
                                const std::uint32_t end = chunks.end(chunk);
                                for (std::uint32_t r = chunk * chunks.per_chunk; r < end; ++r)
                                {
                                    const int y = static_cast<int>(r % ny), z = static_cast<int>(r / ny);
                                    body(box.index(0, y, z), y, z);
                                }
                            });
}

/// Combines body(first, y, z) over all rows by `fold`, the same for any number of threads.
template <class Body, class Fold>
double fold_rows(const PaddedBox& box, const Body& body, const Fold& fold)
{
    const RowChunks chunks(box);
    const auto ny = static_cast<std::uint32_t>(box.ny);
    std::vector<double> parts(chunks.count, 0);
    parallel_for_each_index(chunks.count,
                            [&](std::size_t c)
                            {
                                const auto chunk = static_cast<std::uint32_t>(c);
                                const std::uint32_t end = chunks.end(chunk);
                                double part = 0;
                                for (std::uint32_t r = chunk * chunks.per_chunk; r < end; ++r)
                                {
                                    const int y = static_cast<int>(r % ny), z = static_cast<int>(r / ny);
                                    part = fold(part, body(box.index(0, y, z), y, z));
                                }
                                parts[chunk] = part;
                            });
    double total = 0;
    for (const double part : parts) total = fold(total, part);
    return total;
}

template <class Body>
double sum_rows(const PaddedBox& box, const Body& body)
{
    return fold_rows(box, body, [](double a, double b) { return a + b; });
}

/// sum over i in [0, n) of term(i), in kRowLanes running sums, which the compiler keeps in vector registers.
template <class Term>
double sum_of(int n, const Term& term)
{
    double lane[kRowLanes] = {};
    int i = 0;
    for (; i + kRowLanes <= n; i += kRowLanes)
        for (int k = 0; k < kRowLanes; ++k) lane[k] += term(i + k);
    for (int k = 0; i < n; ++i, ++k) lane[k] += term(i);
    return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

}  // namespace spindrift::cpu
