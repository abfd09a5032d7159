// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/flake_words.h"
#include "core/number.h"
#include "core/vec.h"
#include "core/wind.h"

namespace spindrift
{

/// Keys by which flakes are put in the order of the wind cells that they read, so that neighbours in memory
/// read the same ones. Holes come last.
struct CellOrder
{
    GridWind grid;
    FlakeView flakes;

    SPINDRIFT_HD std::uint32_t cells() const
    {
        return static_cast<std::uint32_t>(grid.nx * grid.ny * grid.nz);
    }
    /// Bits that every key fits in.
    SPINDRIFT_HD int key_bits() const
    {
        int bits = 1;
        while (cells() >> bits != 0) ++bits;
        return bits;
    }
    SPINDRIFT_HD std::uint32_t operator()(std::size_t i) const
    {
        if (!is_alive(flakes.state[i])) return cells();
        return as_uint(grid.locate(Vec3f{flakes.x[i], flakes.y[i], flakes.z[i]}).index);
    }
};

}  // namespace spindrift
