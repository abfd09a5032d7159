// SPDX-License-Identifier: MIT
// Heavy flakes: inertia, and trajectories that cross eddies.
#include <cmath>

#include <gtest/gtest.h>

#include "core/advect.h"
#include "tests/stress/tracers.h"

namespace spindrift::stress
{
namespace
{

constexpr std::uint64_t kFlakes = 6000;

World heavy_world(double dt, double sigma, double time_s)
{
    World w = tracer_world(kFlakes, {400, 400, 400}, dt);
    w.wind = even_air({sigma * sigma, 0, 0, sigma * sigma, 0, sigma * sigma}, 2 * sigma * sigma / time_s);
    w.emitters[0].shape = EmitterShape::point;
    w.emitters[0].a = {200, 200, 200};
    return w;
}

double mean_square(const float* values)
{
    double sum = 0;
    for (std::size_t i = 0; i < kFlakes; ++i)
        sum += static_cast<double>(values[i]) * static_cast<double>(values[i]) / kFlakes;
    return sum;
}

/// In still air from rest: v_t (1 - exp(-t / tau)), tau = v_t / g, for any step.
TEST(Heavy, FallsFromRestExactly)
{
    const double v = static_cast<double>(fall_speed()), tau = v / kGravity;
    for (const double dt : {1e-4, 0.01, 0.1, 10.0})
    {
        World w = tracer_world(10, {10, 10, 400}, dt);
        w.snow.inertia = true;
        w.emitters[0].shape = EmitterShape::point;
        w.emitters[0].a = {5, 5, 300};
        w.emitters[0].at_rest_in_air = false;
        TestRun run(w);
        for (int step = 1; step <= 20; ++step)
        {
            run->step();
            const double t = dt * step, gone = 1 - std::exp(-t / tau);
            ASSERT_NEAR(run.flakes.slip_z[3], -v * gone, 1e-5 * v) << "dt = " << dt;
            ASSERT_NEAR(300 - static_cast<double>(run.flakes.z[3]), v * (t - tau * gone), 20 * 3e-5)
                << "dt = " << dt;
        }
    }
}

/// In turbulence of time T the velocity keeps the share T / (T + tau) of the air's variance, and the spread
/// in the end is the air's, for any step (Tchen 1947).
TEST(Heavy, FollowsTheAirAsFarAsItsInertiaLets)
{
    constexpr double kSigma = 1.2;
    const double tau = static_cast<double>(fall_speed()) / kGravity;
    for (const double time_s : {0.02, 0.1})
    {
        World w = heavy_world(0.002, kSigma, time_s);
        w.snow.inertia = true;
        TestRun run(w);
        constexpr int kSteps = 600;
        run.steps(kSteps);
        ASSERT_EQ(run->counts().alive, kFlakes);
        const double truth = kSigma * kSigma * time_s / (time_s + tau);
        for (const float* v : {run.flakes.slip_x, run.flakes.slip_y, run.flakes.slip_z})
            EXPECT_NEAR(mean_square(v) / truth, 1, 4 * std::sqrt(2.0 / kFlakes) + 0.03) << time_s;
        // far field: K = sigma^2 T, less what the velocity still holds
        const double t = 0.002 * kSteps;
        double spread = 0;
        for (std::size_t i = 0; i < kFlakes; ++i)
            spread += std::pow(static_cast<double>(run.flakes.x[i]) - 200, 2) / kFlakes;
        const double late = 2 * kSigma * kSigma * time_s *
                            (t - (time_s * time_s + time_s * tau + tau * tau) / (time_s + tau));
        EXPECT_NEAR(spread / late, 1, 5 * std::sqrt(2.0 / kFlakes)) << time_s;
    }
    for (const double dt : {1e-4, 0.1, 10.0})
    {
        World w = heavy_world(dt, kSigma, 0.5);
        w.snow.inertia = true;
        TestRun run(w);
        run.steps(10);
        EXPECT_EQ(run->extent().rogue, 0U);
        EXPECT_LT(mean_square(run.flakes.slip_y), 1.2 * kSigma * kSigma) << dt;
    }
}

/// Csanady 1963: the turbulence that a flake meets lasts T / sqrt(1 + (beta v / sigma)^2).
TEST(Heavy, FallingOutOfEddiesShortensTheirTime)
{
    const double sigma = static_cast<double>(fall_speed()) / 2;
    constexpr double dt = 0.02, kTime = 0.4;
    for (const double beta : {0.0, 1.5})
    {
        World w = heavy_world(dt, sigma, kTime);
        w.snow.crossing = static_cast<float>(beta);
        TestRun run(w);
        run->step();
        const std::vector<float> before(run.flakes.q2, run.flakes.q2 + kFlakes);
        run.steps(10);
        double correlation = 0;
        for (std::size_t i = 0; i < kFlakes; ++i)
            correlation += static_cast<double>(before[i]) * static_cast<double>(run.flakes.q2[i]) / kFlakes;
        const double a = dt / kTime * std::sqrt(1 + std::pow(2 * beta, 2));
        EXPECT_NEAR(correlation, std::pow((1 - a / 2) / (1 + a / 2), 10), 4 / std::sqrt(double{kFlakes}))
            << "beta = " << beta;
        EXPECT_NEAR(mean_square(run.flakes.q2), 1, 4 * std::sqrt(2.0 / kFlakes));
    }
}

/// A wall turns the velocity of a heavy flake, and with it the flake.
TEST(Heavy, BouncesWithItsOwnVelocity)
{
    World w = tracer_world(1, {20, 10, 10}, 0.01);
    w.snow.inertia = true;
    w.wind.uniform_m_s = {0, 0, fall_speed()};
    w.voxels = cpu::test::voxels(
        20, 10, 10, 1, [](int x, int, int) { return x >= 11; },
        [](int, int, int) { return std::uint8_t{0}; });
    w.surfaces = {{Contact::bounce, 0.5F}};
    w.emitters[0].shape = EmitterShape::point;
    w.emitters[0].a = {10.95F, 5, 5};
    w.emitters[0].at_rest_in_air = false;
    w.emitters[0].velocity_m_s = {8, 0, 0};
    TestRun run(w);
    run->step();
    const double kept = std::exp(-0.01 * kGravity / static_cast<double>(fall_speed()));
    EXPECT_NEAR(run.flakes.slip_x[0], -4 * kept, 1.0);
    EXPECT_LT(run.flakes.slip_x[0], -2);
    EXPECT_LT(run.flakes.x[0], 11);
}

}  // namespace
}  // namespace spindrift::stress
