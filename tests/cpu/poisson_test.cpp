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

constexpr double kPi = 3.14159265358979323846;

/// Root mean square error, weighted with volume, of x against sin(pi x) sin(pi y / 1.5) cos(pi z / 1.6),
/// whose slope is 0 at the ground and whose value is 0 on the other borders.
double manufactured_error(int n, double stretch)
{
    const PoissonProblem problem = box(n, n + 1, layers(n - 1, stretch));
    PoissonSolver solver(problem);
    const PaddedBox& at = solver.box();
    std::vector<double> b(static_cast<std::size_t>(at.count()), 0), x, truth = b;
    const double k2 = kPi * kPi * (1 + 1 / 2.25 + 1 / 2.56);
    double low = 0;
    for (int z = 0; z < at.nz; ++z)
    {
        const double dz = problem.side_m[2][z], middle = low + 0.5 * dz;
        low += dz;
        for (int j = 0; j < at.ny; ++j)
            for (int i = 0; i < at.nx; ++i)
            {
                const double value = std::sin(kPi * (i + 0.5) / at.nx) * std::sin(kPi * (j + 0.5) / at.ny) *
                                     std::cos(kPi * middle / 1.6);
                truth[at.index(i, j, z)] = value;
                b[at.index(i, j, z)] = k2 * value * dz * 1.5 / (at.nx * at.ny);
            }
    }
    PoissonSettings settings;
    settings.tolerance = 1e-10;
    EXPECT_TRUE(solver.solve(b, x, settings).converged);
    double sum = 0;
    for (int z = 0; z < at.nz; ++z)
        for (int j = 0; j < at.ny; ++j)
            for (int i = 0; i < at.nx; ++i)
            {
                const std::ptrdiff_t c = at.index(i, j, z);
                sum += (x[c] - truth[c]) * (x[c] - truth[c]) * problem.side_m[2][z] / 0.8 / (at.nx * at.ny);
            }
    return std::sqrt(sum);
}

TEST(PoissonSolver, ConvergesWithTheSquareOfTheCell)
{
    for (const double stretch : {0.0, 1.5, 3.0})
    {
        double before = manufactured_error(9, stretch);
        for (const int n : {18, 36, 72})
        {
            const double error = manufactured_error(n, stretch);
            const double order = std::log2(before / error);
            EXPECT_GT(order, 1.85) << n << " cells, stretched by exp " << stretch;
            EXPECT_LT(order, 2.3) << n << " cells, stretched by exp " << stretch;
            before = error;
        }
        EXPECT_LT(before, 1e-3);
    }
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
