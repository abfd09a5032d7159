// SPDX-License-Identifier: MIT
#include "cpu/multigrid.h"

#include <algorithm>
#include <cmath>

#include "core/grid_size.h"
#include "cpu/rows.h"

namespace spindrift::cpu
{

namespace
{

constexpr int kSmoothings = 2;  ///< before and after the coarse correction
constexpr int kCoarsestSmoothings = 8;
constexpr double kAnisotropy = 2.5;  ///< longer cells than this times the shortest are not halved
constexpr int kLeastHalved = 3;      ///< an axis of fewer cells stays

int cells(const PaddedBox& box, int axis)
{
    return axis == 0 ? box.nx : axis == 1 ? box.ny : box.nz;
}

std::ptrdiff_t step(const PaddedBox& box, int axis)
{
    return axis == 0 ? 1 : axis == 1 ? box.row() : box.plane();
}

/// Between the centres on both sides of face f (upper face of cell f - 1); half a cell at the border.
double distance_m(const std::vector<double>& side, int f)
{
    const int n = static_cast<int>(side.size());
    return 0.5 * ((f > 0 ? side[f - 1] : 0) + (f < n ? side[f] : 0));
}

/// AxisMap::toward of one axis, two entries of padding on either side.
std::vector<float> toward_neighbours(const std::vector<double>& fine, const std::vector<double>& coarse,
                                     int halved)
{
    const int n = static_cast<int>(fine.size());
    std::vector<float> toward(fine.size() + 4, 0);
    double low = 0, coarse_low = 0;
    for (int i = 0; i < n && halved != 0; ++i)
    {
        const int j = i >> 1, upper = i & 1;
        const double off = low + 0.5 * fine[i] - (coarse_low + 0.5 * coarse[j]);
        toward[i + 2] = static_cast<float>(std::abs(off) / distance_m(coarse, j + upper));
        low += fine[i];
        if (upper != 0) coarse_low += coarse[j];
    }
    return toward;
}

}  // namespace

Multigrid::Level::Level(const std::array<std::vector<double>, 3>& sides)
    : box{static_cast<int>(sides[0].size()), static_cast<int>(sides[1].size()),
          static_cast<int>(sides[2].size())},
      side_m(sides)
{
    const auto n = static_cast<std::size_t>(box.count());
    for (auto& f : face) f.assign(n, 0);
    inverse_diagonal.assign(n, 0);
    u.assign(n, 0);
    b.assign(n, 0);
    r.assign(n, 0);
}

void Multigrid::Level::invert_diagonal()
{
    const FaceCoefficients c = coefficients();
    for_each_row(box,
                 [&](std::ptrdiff_t first, int, int)
                 {
                     for (std::ptrdiff_t i = first; i < first + box.nx; ++i)
                     {
                         const float sum = c.sum(i);
                         inverse_diagonal[i] = sum > 0 ? 1 / sum : 0;
                     }
                 });
}

bool Multigrid::Level::choose_axes()
{
    double mean[3], shortest = INFINITY;
    for (int a = 0; a < 3; ++a)
    {
        double sum = 0;
        for (const double side : side_m[a]) sum += side;
        mean[a] = sum / cells(box, a);
        if (cells(box, a) >= kLeastHalved) shortest = std::min(shortest, mean[a]);
    }
    bool any = false;
    for (int a = 0; a < 3; ++a)
    {
        halved[a] = cells(box, a) >= kLeastHalved && mean[a] <= kAnisotropy * shortest ? 1 : 0;
        any = any || halved[a] != 0;
    }
    return any;
}

Multigrid::Multigrid(const PoissonProblem& problem)
{
    Level fine(problem.side_m);
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
    fine.invert_diagonal();
    levels_.push_back(std::move(fine));
    while (levels_.back().choose_axes()) add_coarser();
}

void Multigrid::add_coarser()
{
    Level& fine = levels_.back();
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
    Level coarse(sides);
    for (auto& open : coarse.open) open.assign(static_cast<std::size_t>(coarse.box.count()), 0);
    for (int a = 0; a < 3; ++a) average_faces(fine, coarse, a);
    coarse.invert_diagonal();
    levels_.push_back(std::move(coarse));
}

/// The open area of a coarse face is that of the fine faces in it.
void Multigrid::average_faces(const Level& fine, Level& coarse, int axis)
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
                        sum += static_cast<double>(
                            fine.face[axis][first + c * step(fine.box, q) + b * step(fine.box, p)]);
                const double open_m2 = sum * distance_m(fine.side_m[axis], from[axis] + 1);
                const std::ptrdiff_t to = coarse.box.index(at[0], at[1], at[2]);
                coarse.open[axis][to] =
                    static_cast<float>(std::min(open_m2 / (coarse.side_m[p][j] * coarse.side_m[q][k]), 1.0));
                coarse.face[axis][to] = static_cast<float>(open_m2 / distance_m(coarse.side_m[axis], i + 1));
            }
}

void Multigrid::smooth(Level& level, int colour)
{
    const Smoother<float> smoother{level.coefficients(), level.inverse_diagonal.data(), level.b.data(),
                                   level.u.data(), 1.0F};
    const int nx = level.box.nx;
    for_each_row(level.box,
                 [&](std::ptrdiff_t first, int y, int z)
                 {
                     for (int x = (y + z + colour) & 1; x < nx; x += 2) smoother(first + x);
                 });
}

/// smooth(level, 0) where u is zero.
void Multigrid::smooth_from_zero(Level& level)
{
    const int nx = level.box.nx;
    for_each_row(level.box,
                 [&](std::ptrdiff_t first, int y, int z)
                 {
                     float* u = level.u.data() + first;
                     const float *b = level.b.data() + first,
                                 *inverse = level.inverse_diagonal.data() + first;
                     const int colour = (y + z) & 1;
                     for (int x = 0; x < nx; ++x) u[x] = ((x ^ colour) & 1) == 0 ? b[x] * inverse[x] : 0.0F;
                 });
}

void Multigrid::take_residual(Level& level)
{
    const ResidualTaker<float> taker{level.coefficients(), level.inverse_diagonal.data(), level.b.data(),
                                     level.u.data(), level.r.data()};
    for_each_row(level.box,
                 [&](std::ptrdiff_t first, int, int)
                 {
                     for (std::ptrdiff_t i = first; i < first + level.box.nx; ++i) taker(i);
                 });
}

void Multigrid::restrict_to(Level& coarse, const Level& fine)
{
    Restrictor restrictor{fine.box, coarse.box, {}, {}, fine.r.data(), coarse.b.data()};
    for (int a = 0; a < 3; ++a)
    {
        restrictor.map[a] = fine.map(a);
        restrictor.open[a] = coarse.open[a].data();
    }
    for_each_row(coarse.box,
                 [&](std::ptrdiff_t, int y, int z)
                 {
                     for (int x = 0; x < coarse.box.nx; ++x) restrictor(x, y, z);
                 });
}

void Multigrid::prolong(Level& fine, const Level& coarse)
{
    Prolongator prolongator{fine.box,     coarse.box, {}, {}, coarse.u.data(), fine.inverse_diagonal.data(),
                            fine.u.data()};
    for (int a = 0; a < 3; ++a)
    {
        prolongator.map[a] = fine.map(a);
        prolongator.open[a] = coarse.open[a].data();
    }
    for_each_row(fine.box,
                 [&](std::ptrdiff_t, int y, int z)
                 {
                     for (int x = 0; x < fine.box.nx; ++x) prolongator(x, y, z);
                 });
}

void Multigrid::solve_coarsest(Level& level)
{
    smooth_from_zero(level);
    smooth(level, 1);
    for (int i = 1; i < kCoarsestSmoothings; ++i)
        for (const int colour : {0, 1}) smooth(level, colour);
    for (int i = 0; i < kCoarsestSmoothings; ++i)
        for (const int colour : {1, 0}) smooth(level, colour);
}

void Multigrid::cycle(std::size_t index)
{
    Level& level = levels_[index];
    if (index + 1 == levels_.size()) return solve_coarsest(level);
    smooth_from_zero(level);
    smooth(level, 1);
    for (int i = 1; i < kSmoothings; ++i)
        for (const int colour : {0, 1}) smooth(level, colour);
    take_residual(level);
    restrict_to(levels_[index + 1], level);
    cycle(index + 1);
    prolong(level, levels_[index + 1]);
    for (int i = 0; i < kSmoothings; ++i)
        for (const int colour : {1, 0}) smooth(level, colour);
}

}  // namespace spindrift::cpu
