// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/wind.h"
#include "cpu/half_pixels.h"

namespace spindrift::validation
{

enum class Sampling : std::uint32_t
{
    trilinear,
    nearest,
};

/// A wind grid whose numbers are kept as float or as half (`Store`), sampled between cell centres or at the
/// nearest one: what advection is compared over. 16 numbers a cell.
template <class Store, Sampling Sampled>
struct StudyGrid
{
    GridWind grid;  ///< says where a point lies; its cells are not read
    const Store* numbers = nullptr;

    template <class R>
    SPINDRIFT_HD Vec3<R> mean(const Vec3<R>& x) const
    {
        R v[16];
        read(x, v);
        return {v[0], v[1], v[2]};
    }

    template <class R>
    SPINDRIFT_HD Air<R> air(const Vec3<R>& x) const
    {
        R v[16];
        read(x, v);
        return air_of_record(v);
    }

    template <class R>
    SPINDRIFT_HD void read(const Vec3<R>& x, R (&v)[16]) const
    {
        const GridPoint<R> p = grid.locate(x);
        const int step[3] = {grid.step_x, grid.step_y, grid.step_z};
        if constexpr (Sampled == Sampling::nearest)
        {
            const R half = number<R>(0.5);
            const int at = p.index + (p.fx >= half ? step[0] : 0) + (p.fy >= half ? step[1] : 0) +
                           (p.fz >= half ? step[2] : 0);
            for (int k = 0; k < 16; ++k) v[k] = value<R>(at, k);
        }
        else
        {
            R weight[8];
            corner_weights(p, weight);
            for (int k = 0; k < 16; ++k) v[k] = number<R>(0);
            for (int c = 0; c < 8; ++c)
            {
                const int at =
                    p.index + (c & 1 ? step[0] : 0) + (c & 2 ? step[1] : 0) + (c & 4 ? step[2] : 0);
                for (int k = 0; k < 16; ++k) v[k] = fma(weight[c], value<R>(at, k), v[k]);
            }
        }
    }

  private:
    template <class R>
    SPINDRIFT_HD R value(int cell, int k) const
    {
        const Store stored = numbers[static_cast<std::ptrdiff_t>(cell) * 16 + k];
        if constexpr (sizeof(Store) == 2)
            return static_cast<R>(cpu::from_half(stored));
        else
            return static_cast<R>(stored);
    }
};

}  // namespace spindrift::validation
