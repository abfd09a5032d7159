// SPDX-License-Identifier: MIT
// The wind's equation on the device: the processor's bits, step for step.
#include "cuda/poisson_solver.h"

#include <limits>

#include "cpu/poisson_solver.h"
#include "tests/cpu/poisson_cases.h"
#include "tests/cuda/device_fixture.h"

namespace spindrift::gpu
{

namespace
{

using namespace test;

class DevicePoisson : public DeviceTest
{
  protected:
    struct Solved
    {
        PoissonResult done;
        std::vector<double> x;
        std::vector<double> residuals;  ///< of every iteration
    };

    static Solved solve(PoissonSolver& solver, const std::vector<double>& b, PoissonSettings settings)
    {
        Solved solved;
        settings.progress = [&](int, double residual) { solved.residuals.push_back(residual); };
        solved.done = solver.solve(b, solved.x, settings);
        return solved;
    }

    static void expect_same(const PoissonProblem& problem, const PoissonSettings& settings)
    {
        cpu::PoissonSolver host(problem);
        const auto device = make_poisson_solver(problem);
        const std::vector<double> b = wall_sources(problem, host.box());
        const Solved expected = solve(host, b, settings), solved = solve(*device, b, settings);
        EXPECT_EQ(solved.done.iterations, expected.done.iterations);
        EXPECT_EQ(solved.done.relative_residual, expected.done.relative_residual);
        EXPECT_EQ(solved.done.converged, expected.done.converged);
        EXPECT_EQ(solved.residuals, expected.residuals);
        EXPECT_GT(solved.residuals.size(), 0U);
        EXPECT_EQ(solved.x, expected.x);
        const std::vector<double> again = solve(*device, b, settings).x;
        EXPECT_EQ(again, expected.x) << "the second time";
    }
};

/// Rows at the ends of the eight sums, even and stretched layers, flat and long boxes.
TEST_F(DevicePoisson, GivesTheProcessorsBits)
{
    struct Size
    {
        int nx, ny, nz;
        double stretch;
    };
    for (const Size& size :
         {Size{20, 17, 13, 1}, Size{7, 23, 9, 0}, Size{33, 9, 8, 2}, Size{64, 24, 12, 0.5}})
    {
        SCOPED_TRACE(size.nx);
        PoissonProblem problem = box(size.nx, size.ny, layers(size.nz, size.stretch));
        build_streets(problem);
        expect_same(problem, {});
        PoissonSettings largest;
        largest.largest_residual = 1e-5;
        expect_same(problem, largest);
    }
}

TEST_F(DevicePoisson, RelaxesAsTheProcessorDoes)
{
    PoissonProblem problem = box(20, 17, layers(13, 1));
    build_streets(problem);
    PoissonSettings settings;
    settings.method = PoissonMethod::over_relaxation;
    settings.tolerance = 1e-3;
    expect_same(problem, settings);
}

TEST_F(DevicePoisson, NeedsNothingForNothing)
{
    const auto device = make_poisson_solver(box(9, 8, layers(7, 0)));
    std::vector<double> x;
    const std::vector<double> nothing(static_cast<std::size_t>(device->box().count()), 0);
    const PoissonResult done = device->solve(nothing, x, {});
    EXPECT_TRUE(done.converged);
    EXPECT_EQ(done.iterations, 0);
    EXPECT_EQ(x, nothing);
}

TEST_F(DevicePoisson, SaysThatItDidNotConverge)
{
    const PoissonProblem problem = box(12, 12, layers(12, 0));
    const auto device = make_poisson_solver(problem);
    std::vector<double> b(static_cast<std::size_t>(device->box().count()), 0), x;
    b[static_cast<std::size_t>(device->box().index(7, 8, 9))] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(device->solve(b, x, {}).relative_residual > 0);
    b[static_cast<std::size_t>(device->box().index(7, 8, 9))] = 1;
    PoissonSettings settings;
    settings.most_iterations = 1;
    const PoissonResult done = device->solve(b, x, settings);
    EXPECT_FALSE(done.converged);
    EXPECT_EQ(done.iterations, 1);
}

}  // namespace

}  // namespace spindrift::gpu
