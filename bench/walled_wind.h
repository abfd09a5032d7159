// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "core/grid_size.h"
#include "core/poisson_levels.h"

namespace spindrift::bench
{

/// What a projection solves.
struct WalledWind
{
    PoissonProblem problem;
    std::vector<double> b;  ///< outflow that a wind of 1 m/s along x leaves at the walls
};

/// Cells of 2 m round twelve buildings of random places and sizes.
inline WalledWind twelve_buildings(int nx, int ny, int nz)
{
    WalledWind c;
    c.problem.side_m[0].assign(static_cast<std::size_t>(nx), 2.0);
    c.problem.side_m[1].assign(static_cast<std::size_t>(ny), 2.0);
    c.problem.side_m[2].assign(static_cast<std::size_t>(nz), 2.0);
    c.problem.zero_border = {true, true, true, true, false, true};
    const GridSize n{nx, ny, nz};
    c.problem.part.assign(n.count(), 1);
    std::mt19937 engine(3);
    const auto any = [&](int most) { return static_cast<int>(engine() % static_cast<unsigned>(most)); };
    for (int house = 0; house < 12; ++house)
    {
        const int x0 = nx / 8 + any(nx * 5 / 8), y0 = ny / 8 + any(ny * 5 / 8);
        const int dx = 5 + any(nx / 8), dy = 5 + any(ny / 8), height = 3 + any(nz / 3);
        for (int z = 0; z < height; ++z)
            for (int y = y0; y < y0 + dy; ++y)
                for (int x = x0; x < x0 + dx; ++x) c.problem.part[n.index(x, y, z)] = 0;
    }
    const PaddedBox at{nx, ny, nz};
    c.b.assign(static_cast<std::size_t>(at.count()), 0);
    const auto wall = [&](int x, int y, int z)
    { return c.problem.part[n.index(x, y, z)] == 0 ? 4.0 : 0.0; };  // m2
    for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
            for (int x = 1; x + 1 < nx; ++x)
                if (c.problem.part[n.index(x, y, z)] != 0)
                    c.b[at.index(x, y, z)] = wall(x - 1, y, z) - wall(x + 1, y, z);
    return c;
}

/// Root mean square of the velocities that two potentials differ by; the wind is 1 m/s.
inline double velocity_error(const PaddedBox& at, const FaceCoefficients& c, const std::vector<double>& x,
                             const std::vector<double>& truth)
{
    double sum = 0;
    for (int k = 0; k < at.nz; ++k)
        for (int j = 0; j < at.ny; ++j)
            for (int i = 0; i < at.nx; ++i)
            {
                const std::ptrdiff_t at_cell = at.index(i, j, k);
                const auto part = [&](const float* face, std::ptrdiff_t step)
                {
                    const double flow =
                        static_cast<double>(face[at_cell]) *
                        ((x[at_cell + step] - x[at_cell]) - (truth[at_cell + step] - truth[at_cell]));
                    return flow * flow / 16;  // faces of 4 m2
                };
                sum += part(c.x, 1) + part(c.y, c.row) + part(c.z, c.plane);
            }
    return std::sqrt(sum / (static_cast<double>(at.nx) * at.ny * at.nz));
}

}  // namespace spindrift::bench
