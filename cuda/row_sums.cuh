// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/poisson.h"
#include "cuda/buffer.h"
#include "cuda/launch.cuh"

namespace spindrift::gpu
{

/// Calls `body(x, y, z)` for every cell of a box, in any order.
template <class Body>
struct ForEachCell
{
    PaddedBox box;
    Body body;

    __device__ void operator()(std::size_t cell) const
    {
        const auto i = static_cast<std::uint32_t>(cell);
        const auto nx = static_cast<std::uint32_t>(box.nx), ny = static_cast<std::uint32_t>(box.ny);
        const std::uint32_t row = i / nx;
        body(static_cast<int>(i % nx), static_cast<int>(row % ny), static_cast<int>(row / ny));
    }
};

/// kRowLanes threads a row: each adds up its elements, and they join their sums as RowChunks says.
template <class Term>
struct SumRow
{
    PaddedBox box;
    Term term;
    double* of_row;

    __device__ void operator()(std::size_t thread) const
    {
        const auto row = static_cast<std::uint32_t>(thread / kRowLanes);
        const int lane = static_cast<int>(thread % kRowLanes);
        const auto ny = static_cast<std::uint32_t>(box.ny);
        const std::ptrdiff_t first = box.index(0, static_cast<int>(row % ny), static_cast<int>(row / ny));
        double sum = 0;
        for (int x = lane; x < box.nx; x += kRowLanes) sum += term(first + x);
        // threads come in whole rows, so that these eight are all here
        const unsigned eight = 0xFFU << (threadIdx.x % 32 / kRowLanes * kRowLanes);
        for (int distance = 1; distance < kRowLanes; distance *= 2)
            sum += __shfl_xor_sync(eight, sum, distance);
        if (lane == 0) of_row[row] = sum;
    }
};

struct Add
{
    SPINDRIFT_HD double operator()(double a, double b) const { return a + b; }
};
struct Larger
{
    SPINDRIFT_HD double operator()(double a, double b) const { return a < b ? b : a; }
};

/// One block: a thread a chunk joins its rows, then the first joins the chunks.
template <class Fold>
struct FoldRows
{
    RowChunks chunks;
    Fold fold;
    const double* of_row;
    double* of_chunk;
    double* total;

    __device__ void operator()() const
    {
        for (std::uint32_t c = threadIdx.x; c < chunks.count; c += blockDim.x)
        {
            double part = 0;
            const std::uint32_t end = chunks.end(c);
            for (std::uint32_t row = c * chunks.per_chunk; row < end; ++row) part = fold(part, of_row[row]);
            of_chunk[c] = part;
        }
        __syncthreads();
        if (threadIdx.x != 0) return;
        double all = 0;
        for (std::uint32_t c = 0; c < chunks.count; ++c) all = fold(all, of_chunk[c]);
        *total = all;
    }
};

template <class OfRow>
struct TakeRow
{
    OfRow of;
    int ny;
    double* of_row;
    __device__ void operator()(std::size_t row) const
    {
        const auto r = static_cast<int>(row);
        of_row[row] = of(r % ny, r / ny);
    }
};

/// Sums over the cells of a box, with the bits of cpu/rows.h. Each waits for its result.
class RowSums
{
  public:
    explicit RowSums(const PaddedBox& box)
        : box_(box), chunks_(box), of_row_(chunks_.rows), of_chunk_(chunks_.count), total_(1), host_(1)
    {
    }

    /// Of term(index) over all cells, each called once.
    template <class Term>
    double sum(StreamRef stream, const char* name, const Term& term)
    {
        launch(stream, name, std::size_t{chunks_.rows} * kRowLanes, SumRow<Term>{box_, term, of_row_.data()});
        return fold<Add>(stream);
    }

    /// The largest of of_row(y, z), if it is more than 0.
    template <class OfRow>
    double largest(StreamRef stream, const char* name, const OfRow& of_row)
    {
        const int ny = box_.ny;
        launch(stream, name, chunks_.rows, TakeRow<OfRow>{of_row, ny, of_row_.data()});
        return fold<Larger>(stream);
    }

  private:
    template <class Fold>
    double fold(StreamRef stream)
    {
        launch_blocks(stream, "fold rows", 1, kBlockThreads,
                      FoldRows<Fold>{chunks_, {}, of_row_.data(), of_chunk_.data(), total_.data()});
        copy_to_host(stream, host_.data(), total_.data(), 1);
        stream.wait();
        return host_[0];
    }

    PaddedBox box_;
    RowChunks chunks_;
    DeviceBuffer<double> of_row_, of_chunk_, total_;
    PinnedBuffer<double> host_;
};

}  // namespace spindrift::gpu
