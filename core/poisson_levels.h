// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/grid_size.h"
#include "core/math.h"
#include "core/poisson.h"

namespace spindrift
{

/// -div grad on a box of cells: which of them take part, how large they are, and what holds at the border.
struct PoissonProblem
{
    std::array<std::vector<double>, 3> side_m;  ///< of the columns, rows and layers of cells
    std::vector<std::uint8_t> part;             ///< 1: an unknown; x fastest, no border. Else a wall
    std::array<bool, 6> zero_border{};  ///< x low, x high, y low ...: 0 on that face of the box; else a wall
};

/// A grid of the multigrid, on the host, as every backend takes it: all but its numbers on the way.
struct PoissonLevel
{
    PaddedBox box;
    std::array<std::vector<double>, 3> side_m;
    std::array<std::vector<float>, 3> face;    ///< c_f
    std::array<std::vector<float>, 3> open;    ///< of Prolongator; coarser levels only
    std::array<int, 3> halved{};               ///< on the way to the next level
    std::array<std::vector<float>, 3> toward;  ///< AxisMap::toward, with two entries more in front and behind

    explicit PoissonLevel(const std::array<std::vector<double>, 3>& sides)
        : box{static_cast<int>(sides[0].size()), static_cast<int>(sides[1].size()),
              static_cast<int>(sides[2].size())},
          side_m(sides)
    {
        for (auto& f : face) f.assign(static_cast<std::size_t>(box.count()), 0);
    }
};

namespace detail
{

inline constexpr double kAnisotropy = 2.5;  ///< longer cells than this times the shortest are not halved
inline constexpr int kLeastHalved = 3;      ///< an axis of fewer cells stays

inline int cells(const PaddedBox& box, int axis)
{
    return axis == 0 ? box.nx : axis == 1 ? box.ny : box.nz;
}

inline std::ptrdiff_t poisson_step(const PaddedBox& box, int axis)
{
    return axis == 0 ? 1 : axis == 1 ? box.row() : box.plane();
}

/// Between the centres on both sides of face f (upper face of cell f - 1); half a cell at the border.
inline double distance_m(const std::vector<double>& side, int f)
{
    const int n = static_cast<int>(side.size());
    return 0.5 * ((f > 0 ? side[f - 1] : 0) + (f < n ? side[f] : 0));
}

/// AxisMap::toward of one axis, two entries of padding on either side.
inline std::vector<float> toward_neighbours(const std::vector<double>& fine,
                                            const std::vector<double>& coarse, int halved)
{
    const int n = static_cast<int>(fine.size());
    std::vector<float> toward(fine.size() + 4, 0);
    double low = 0, coarse_low = 0;
    for (int i = 0; i < n && halved != 0; ++i)
    {
        const int j = i >> 1, upper = i & 1;
        const double off = low + 0.5 * fine[i] - (coarse_low + 0.5 * coarse[j]);
        toward[i + 2] = static_cast<float>(abs(off) / distance_m(coarse, j + upper));
        low += fine[i];
        if (upper != 0) coarse_low += coarse[j];
    }
    return toward;
}

/// Halves what has the shortest cells; false: nothing is left to halve.
inline bool choose_axes(PoissonLevel& level)
{
    double mean[3] = {}, shortest = infinity<double>();
    for (int a = 0; a < 3; ++a)
    {
        double sum = 0;
        for (const double side : level.side_m[a]) sum += side;
        mean[a] = sum / cells(level.box, a);
        if (cells(level.box, a) >= kLeastHalved) shortest = std::min(shortest, mean[a]);
    }
    bool any = false;
    for (int a = 0; a < 3; ++a)
    {
        level.halved[a] = cells(level.box, a) >= kLeastHalved && mean[a] <= kAnisotropy * shortest ? 1 : 0;
        any = any || level.halved[a] != 0;
    }
    return any;
}

/// The open area of a coarse face is that of the fine faces in it.
inline void average_faces(const PoissonLevel& fine, PoissonLevel& coarse, int axis)
{
    const int p = (axis + 1) % 3, q = (axis + 2) % 3;
    const int n = cells(coarse.box, axis), fine_n = cells(fine.box, axis);
    for (int k = 0; k < cells(coarse.box, q); ++k)
        for (int j = 0; j < cells(coarse.box, p); ++j)
            for (int i = -1; i < n; ++i)
            {
                int at[3], from[3];
                at[axis] = i, at[p] = j, at[q] = k;
                from[axis] = i < 0 ? -1 : std::min(((i + 1) << fine.halved[axis]) - 1, fine_n - 1);
                from[p] = j << fine.halved[p], from[q] = k << fine.halved[q];
                const std::ptrdiff_t first = fine.box.index(from[0], from[1], from[2]);
                double sum = 0;
                for (int c = 0; c <= fine.halved[q]; ++c)
                    for (int b = 0; b <= fine.halved[p]; ++b)
                        sum += static_cast<double>(fine.face[axis][first + c * poisson_step(fine.box, q) +
                                                                   b * poisson_step(fine.box, p)]);
                const double open_m2 = sum * distance_m(fine.side_m[axis], from[axis] + 1);
                const std::ptrdiff_t to = coarse.box.index(at[0], at[1], at[2]);
                coarse.open[axis][to] =
                    static_cast<float>(std::min(open_m2 / (coarse.side_m[p][j] * coarse.side_m[q][k]), 1.0));
                coarse.face[axis][to] = static_cast<float>(open_m2 / distance_m(coarse.side_m[axis], i + 1));
            }
}

inline PoissonLevel finest_level(const PoissonProblem& problem)
{
    PoissonLevel fine(problem.side_m);
    const PaddedBox box = fine.box;
    const auto part = [&](int x, int y, int z)
    {
        const bool inside = x >= 0 && y >= 0 && z >= 0 && x < box.nx && y < box.ny && z < box.nz;
        return inside && problem.part[GridSize{box.nx, box.ny, box.nz}.index(x, y, z)] != 0;
    };
    for (int z = -1; z < box.nz; ++z)
        for (int y = -1; y < box.ny; ++y)
            for (int x = -1; x < box.nx; ++x)
            {
                const int at[3] = {x, y, z};
                const bool here = part(x, y, z);
                for (int a = 0; a < 3; ++a)
                {
                    const int n = cells(box, a);
                    const bool there = part(x + (a == 0), y + (a == 1), z + (a == 2));
                    const bool joined = at[a] < 0        ? there && problem.zero_border[2 * a]
                                        : at[a] + 1 == n ? here && problem.zero_border[2 * a + 1]
                                                         : here && there;
                    if (!joined) continue;
                    const int p = (a + 1) % 3, q = (a + 2) % 3;
                    fine.face[a][box.index(x, y, z)] =
                        static_cast<float>(fine.side_m[p][at[p]] * fine.side_m[q][at[q]] /
                                           distance_m(fine.side_m[a], at[a] + 1));
                }
            }
    return fine;
}

inline PoissonLevel coarser_level(PoissonLevel& fine)
{
    std::array<std::vector<double>, 3> sides;
    for (int a = 0; a < 3; ++a)
    {
        const std::vector<double>& from = fine.side_m[a];
        const int halved = fine.halved[a], n = cells(fine.box, a), coarse_n = (n + halved) >> halved;
        for (int j = 0; j < coarse_n; ++j)
        {
            const int first = j << halved;
            sides[a].push_back(from[first] + (halved != 0 && first + 1 < n ? from[first + 1] : 0));
        }
        fine.toward[a] = toward_neighbours(from, sides[a], halved);
    }
    PoissonLevel coarse(sides);
    for (auto& open : coarse.open) open.assign(static_cast<std::size_t>(coarse.box.count()), 0);
    for (int a = 0; a < 3; ++a) average_faces(fine, coarse, a);
    return coarse;
}

}  // namespace detail

/// The grids of a geometric multigrid, finest first. Axes are halved while their cells are the shortest
/// (semi-coarsening), a coarse face is as open as its fine faces are on average.
inline std::vector<PoissonLevel> poisson_levels(const PoissonProblem& problem)
{
    std::vector<PoissonLevel> levels;
    levels.push_back(detail::finest_level(problem));
    while (detail::choose_axes(levels.back())) levels.push_back(detail::coarser_level(levels.back()));
    return levels;
}

}  // namespace spindrift
