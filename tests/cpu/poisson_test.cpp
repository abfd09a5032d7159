// SPDX-License-Identifier: MIT
#include "cpu/poisson_solver.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <random>

#include "tests/cpu/poisson_cases.h"

namespace spindrift::cpu
{
namespace
{

using namespace test;

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
