// SPDX-License-Identifier: MIT
#include "cpu/poisson_solver.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <random>

#include "core/grid_size.h"

namespace spindrift::cpu
{
namespace
{

PoissonProblem box(int nx, int ny, std::vector<double> layers)
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
std::vector<double> layers(int n, double stretch)
{
    std::vector<double> result;
    const auto height = [&](double share)
    { return stretch == 0 ? 0.8 * share : 0.8 * std::expm1(stretch * share) / std::expm1(stretch); };
    for (int k = 0; k < n; ++k) result.push_back(height((k + 1.0) / n) - height(static_cast<double>(k) / n));
    return result;
}

/// Streets of odd widths between houses of odd sizes.
void build_streets(PoissonProblem& problem)
{
    const GridSize n{static_cast<int>(problem.side_m[0].size()), static_cast<int>(problem.side_m[1].size()),
                     static_cast<int>(problem.side_m[2].size())};
    for (int z = 0; z < n.nz / 3; ++z)
        for (int y = n.ny / 8; y < n.ny * 7 / 8; ++y)
            for (int x = n.nx / 8; x < n.nx * 7 / 8; ++x)
                if (x % 9 >= 2 && y % 11 >= 3) problem.part[n.index(x, y, z)] = 0;
}

/// Outflow of a jump of the wind at every wall: what a projection has to solve.
std::vector<double> wall_sources(const PoissonProblem& problem, const PaddedBox& at)
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

TEST(PoissonSolver, TakesFewIterationsWhateverTheSize)
{
    for (const int n : {33, 65, 97})
    {
        PoissonProblem problem = box(n, n + 7, layers(n / 2, 0));
        build_streets(problem);
        PoissonSolver solver(problem);
        std::vector<double> x;
        const PoissonResult done = solver.solve(wall_sources(problem, solver.box()), x, {});
        EXPECT_TRUE(done.converged);
        EXPECT_LE(done.relative_residual, 1e-6);
        EXPECT_LE(done.iterations, 14) << n;
    }
}

TEST(PoissonSolver, BothMethodsGiveTheSame)
{
    PoissonProblem problem = box(20, 17, layers(13, 1));
    build_streets(problem);
    PoissonSolver solver(problem);
    const std::vector<double> b = wall_sources(problem, solver.box());
    std::vector<double> x, y;
    PoissonSettings settings;
    settings.tolerance = 1e-10;
    EXPECT_TRUE(solver.solve(b, x, settings).converged);
    settings.method = PoissonMethod::over_relaxation;
    const PoissonResult relaxed = solver.solve(b, y, settings);
    EXPECT_TRUE(relaxed.converged);
    EXPECT_GT(relaxed.iterations, 20);
    double most = 0, size = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        most = std::max(most, std::abs(x[i] - y[i]));
        size = std::max(size, std::abs(x[i]));
    }
    EXPECT_GT(size, 0);
    EXPECT_LT(most, 1e-7 * size);
}

TEST(PoissonSolver, IsTheSameForAnyNumberOfThreads)
{
    PoissonProblem problem = box(70, 60, layers(40, 0.5));
    build_streets(problem);
    PoissonSolver solver(problem);
    const std::vector<double> b = wall_sources(problem, solver.box());
    std::vector<double> one, three;
    tbb::task_arena(1).execute([&] { solver.solve(b, one, {}); });
    tbb::task_arena(3).execute([&] { solver.solve(b, three, {}); });
    EXPECT_EQ(one, three);
}

TEST(PoissonSolver, SaysThatItDidNotConverge)
{
    const PoissonProblem problem = box(30, 30, layers(30, 0));
    PoissonSolver solver(problem);
    std::vector<double> b(static_cast<std::size_t>(solver.box().count()), 0), x;
    b[solver.box().index(7, 8, 9)] = 1;
    PoissonSettings settings;
    settings.most_iterations = 2;
    const PoissonResult done = solver.solve(b, x, settings);
    EXPECT_FALSE(done.converged);
    EXPECT_EQ(done.iterations, 2);
    EXPECT_GT(done.relative_residual, 1e-6);
}

/// A V-cycle must be symmetric, or conjugate gradients may not be preconditioned by it.
TEST(Multigrid, IsSymmetric)
{
    std::mt19937 engine(8);
    std::uniform_real_distribution<float> any(-1, 1);
    PoissonProblem problem = box(21, 18, layers(15, 2));
    for (auto& part : problem.part) part = engine() % 4 != 0 ? 1 : 0;
    Multigrid multigrid(problem);
    EXPECT_GE(multigrid.levels(), 3U);
    const PaddedBox& at = multigrid.box();
    const auto n = static_cast<std::size_t>(at.count());
    std::vector<float> b[2], image[2];
    for (int v = 0; v < 2; ++v)
    {
        b[v].assign(n, 0);
        for (int z = 0; z < at.nz; ++z)
            for (int y = 0; y < at.ny; ++y)
                for (int x = 0; x < at.nx; ++x)
                    if (const auto i = at.index(x, y, z); multigrid.inverse_diagonal()[i] != 0)
                        b[v][i] = any(engine);
        std::copy(b[v].begin(), b[v].end(), multigrid.right_hand_side());
        multigrid.cycle();
        image[v].assign(multigrid.result(), multigrid.result() + n);
    }
    double one = 0, other = 0, positive = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
        one += static_cast<double>(b[0][i]) * static_cast<double>(image[1][i]);
        other += static_cast<double>(b[1][i]) * static_cast<double>(image[0][i]);
        positive += static_cast<double>(b[0][i]) * static_cast<double>(image[0][i]);
    }
    EXPECT_GT(positive, 0);
    EXPECT_NEAR(one, other, 1e-5 * positive);
}

}  // namespace
}  // namespace spindrift::cpu
