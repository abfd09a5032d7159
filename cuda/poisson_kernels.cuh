// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/poisson.h"
#include "cuda/launch.cuh"
#include "cuda/row_sums.cuh"

namespace spindrift::gpu
{

/// The cells of one colour of a chequerboard.
template <class R>
struct SmoothColour
{
    PaddedBox box;
    Smoother<R> smoother;
    int colour;

    __device__ void operator()(std::size_t half_cell) const
    {
        const auto i = static_cast<std::uint32_t>(half_cell);
        const auto half = (static_cast<std::uint32_t>(box.nx) + 1) / 2,
                   ny = static_cast<std::uint32_t>(box.ny);
        const std::uint32_t row = i / half;
        const auto y = static_cast<int>(row % ny), z = static_cast<int>(row / ny);
        const int x = static_cast<int>(2 * (i % half)) + ((y + z + colour) & 1);
        if (x < box.nx) smoother(box.index(x, y, z));
    }
};

template <class R>
void smooth_colour(StreamRef stream, const PaddedBox& box, const Smoother<R>& smoother, int colour)
{
    const std::size_t half = (static_cast<std::size_t>(box.nx) + 1) / 2;
    launch(stream, "smooth", half * static_cast<std::size_t>(box.ny) * static_cast<std::size_t>(box.nz),
           SmoothColour<R>{box, smoother, colour});
}

/// Calls `body(x, y, z)` for every cell.
template <class Body>
void for_each_cell(StreamRef stream, const char* name, const PaddedBox& box, const Body& body)
{
    launch(stream, name,
           static_cast<std::size_t>(box.nx) * static_cast<std::size_t>(box.ny) *
               static_cast<std::size_t>(box.nz),
           ForEachCell<Body>{box, body});
}

/// A functor of the index of a cell as one of its place.
template <class Of>
struct AtIndex
{
    PaddedBox box;
    Of of;
    __device__ void operator()(int x, int y, int z) const { of(box.index(x, y, z)); }
};

}  // namespace spindrift::gpu
