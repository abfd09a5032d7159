// SPDX-License-Identifier: MIT
#include "cpu/multigrid.h"

#include "cpu/rows.h"

namespace spindrift::cpu
{

Multigrid::Level::Level(PoissonLevel grid) : PoissonLevel(std::move(grid))
{
    for (auto* array : {&inverse_diagonal, &u, &b, &r})
        array->assign(static_cast<std::size_t>(box.count()), 0);
    const DiagonalInverter invert{coefficients(), inverse_diagonal.data()};
    for_each_row(box,
                 [&](std::ptrdiff_t first, int, int)
                 {
                     for (std::ptrdiff_t i = first; i < first + box.nx; ++i) invert(i);
                 });
}

Multigrid::Multigrid(const PoissonProblem& problem)
{
    for (PoissonLevel& level : poisson_levels(problem)) levels_.emplace_back(std::move(level));
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
    const SmootherFromZero smoother{level.inverse_diagonal.data(), level.b.data(), level.u.data()};
    const int nx = level.box.nx;
    for_each_row(level.box,
                 [&](std::ptrdiff_t first, int y, int z)
                 {
                     for (int x = 0; x < nx; ++x) smoother(first + x, x + y + z);
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
