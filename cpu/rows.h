// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "core/poisson.h"
#include "cpu/parallel.h"

namespace spindrift::cpu
{

namespace detail
{

/// Rows are dealt out in chunks whose borders depend on the box alone: so do the roundings of a sum.
struct RowChunks
{
    static constexpr int kCellsPerChunk = 16384;
    std::size_t rows, per_chunk, count;

    explicit RowChunks(const PaddedBox& box)
        : rows(static_cast<std::size_t>(box.ny) * static_cast<std::size_t>(box.nz)),
          per_chunk(static_cast<std::size_t>(std::max(1, kCellsPerChunk / std::max(box.nx, 1)))),
          count((rows + per_chunk - 1) / per_chunk)
    {
    }
};

}  // namespace detail

/// Calls body(first, y, z) for every row of cells along x, on the threads of the current arena; `first` is
/// the index of the row's first cell.
template <class Body>
void for_each_row(const PaddedBox& box, const Body& body)
{
    const detail::RowChunks chunks(box);
    const auto ny = static_cast<std::size_t>(box.ny);
    parallel_for_each_index(chunks.count,
                            [&](std::size_t chunk)
                            {
                                const std::size_t end = std::min(chunks.rows, (chunk + 1) * chunks.per_chunk);
                                for (std::size_t r = chunk * chunks.per_chunk; r < end; ++r)
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
    const detail::RowChunks chunks(box);
    const auto ny = static_cast<std::size_t>(box.ny);
    std::vector<double> parts(chunks.count, 0);
    parallel_for_each_index(chunks.count,
                            [&](std::size_t chunk)
                            {
                                const std::size_t end = std::min(chunks.rows, (chunk + 1) * chunks.per_chunk);
                                double part = 0;
                                for (std::size_t r = chunk * chunks.per_chunk; r < end; ++r)
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

/// sum over i in [0, n) of term(i), in eight running sums, which the compiler keeps in vector registers.
template <class Term>
double sum_of(int n, const Term& term)
{
    constexpr int kLanes = 8;
    double lane[kLanes] = {};
    int i = 0;
    for (; i + kLanes <= n; i += kLanes)
        for (int k = 0; k < kLanes; ++k) lane[k] += term(i + k);
    for (int k = 0; i < n; ++i, ++k) lane[k] += term(i);
    return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

}  // namespace spindrift::cpu
