// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace spindrift
{

/// Cells along the three axes; x fastest, then y, then z.
struct GridSize
{
    int nx = 0, ny = 0, nz = 0;

    std::size_t count() const
    {
        return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz);
    }
    std::size_t index(int x, int y, int z) const
    {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(ny) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(nx) +
               static_cast<std::size_t>(x);
    }
};

}  // namespace spindrift
