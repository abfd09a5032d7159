// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "core/grid_size.h"
#include "core/poisson_levels.h"

namespace spindrift::test
{

inline PoissonProblem box(int nx, int ny, std::vector<double> layers)
{
    PoissonProblem problem;
    problem.side_m[0].assign(static_cast<std::size_t>(nx), 1.0 / nx);
    problem.side_m[1].assign(static_cast<std::size_t>(ny), 1.5 / ny);
    problem.side_m[2] = std::move(layers);
    problem.part.assign(problem.side_m[0].size() * problem.side_m[1].size() * problem.side_m[2].size(), 1);
    problem.zero_border = {true, true, true, true, false, true};
    return problem;
}

/// Layers over a height of 0.8, the highest exp(stretch) times as thick as the lowest.
inline std::vector<double> layers(int n, double stretch)
{
    std::vector<double> result;
    const auto height = [&](double share)
    { return stretch == 0 ? 0.8 * share : 0.8 * std::expm1(stretch * share) / std::expm1(stretch); };
    for (int k = 0; k < n; ++k) result.push_back(height((k + 1.0) / n) - height(static_cast<double>(k) / n));
    return result;
}

/// Streets of odd widths between houses of odd sizes.
inline void build_streets(PoissonProblem& problem)
{
    const GridSize n{static_cast<int>(problem.side_m[0].size()), static_cast<int>(problem.side_m[1].size()),
                     static_cast<int>(problem.side_m[2].size())};
    for (int z = 0; z < n.nz / 3; ++z)
        for (int y = n.ny / 8; y < n.ny * 7 / 8; ++y)
            for (int x = n.nx / 8; x < n.nx * 7 / 8; ++x)
                if (x % 9 >= 2 && y % 11 >= 3) problem.part[n.index(x, y, z)] = 0;
}

/// Outflow of a jump of the wind at every wall: what a projection has to solve.
inline std::vector<double> wall_sources(const PoissonProblem& problem, const PaddedBox& at)
{
    std::vector<double> b(static_cast<std::size_t>(at.count()), 0);
    const GridSize n{at.nx, at.ny, at.nz};
    for (int z = 0; z < at.nz; ++z)
        for (int y = 0; y < at.ny; ++y)
            for (int x = 1; x + 1 < at.nx; ++x)
                if (problem.part[n.index(x, y, z)] != 0)
                    b[at.index(x, y, z)] = (problem.part[n.index(x + 1, y, z)] == 0 ? -1 : 0) +
                                           (problem.part[n.index(x - 1, y, z)] == 0 ? 1 : 0);
    return b;
}

}  // namespace spindrift::test
