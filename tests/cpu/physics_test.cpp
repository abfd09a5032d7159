// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/advect.h"
#include "core/gradient_reach.h"
#include "core/wind.h"
#include "worlds.h"

namespace spindrift::cpu::test
{
namespace
{

/// A tall, empty world in which nothing is met; flakes start in a slab in its middle.
World open_world(std::uint64_t flakes, Vec3f size_m, double step_s)
{
    World w;
    w.size_m = size_m;
    w.on_leave = OnLeave::wrap;
    w.has_ground = false;
    w.capacity = flakes;
    w.step_s = step_s;
    Emitter e;
    e.shape = EmitterShape::box;
    e.a = {0, 0, 0.5F * size_m.z}, e.b = {size_m.x, size_m.y, 0.5F * size_m.z};
    e.burst = flakes;
    w.emitters.push_back(e);
    return w;
}

TEST(FlakeAdvector, ReachesTerminalSpeedExactly)
{
    for (const double dt : {0.001, 0.02, 0.5})
    {
        World w = open_world(500, {10, 10, 200}, dt);
        w.emitters[0].at_rest_in_air = false;
        TestRun run(w);
        const FallSpeed fall(w.snow, w.seed);
        for (int step = 1; step <= 40; ++step)
        {
            run->step();
            const double t = dt * step;
            for (std::size_t i = 0; i < 500; ++i)
            {
                const double v = static_cast<double>(fall.at<float>(run.flakes.id[i]));
                const double tau = v / kGravity;
                const double speed = v - static_cast<double>(run.flakes.slip_z[i]);
                ASSERT_NEAR(speed, v * (1 - std::exp(-t / tau)), 3e-6 * v + 1.5e-6);
                const double fallen = 100.0 - static_cast<double>(run.flakes.z[i]);
                ASSERT_NEAR(fallen, v * t - v * tau * (1 - std::exp(-t / tau)), 40 * 8e-6 + 1e-6 * fallen);
            }
        }
    }
}

TEST(FlakeAdvector, LosesAThrowToTheAir)
{
    World w = open_world(100, {100, 100, 100}, 0.02);
    w.wind.uniform_m_s = {2, 0, 0};
    Emitter& e = w.emitters[0];
    e.shape = EmitterShape::point;
    e.a = {20, 20, 50};
    e.at_rest_in_air = false;
    e.velocity_m_s = {-3, 8, 4};
    TestRun run(w);
    run.steps(150);  // 3 s: thirty relaxation times
    const FallSpeed fall(w.snow, w.seed);
    for (std::size_t i = 0; i < 100; ++i)
    {
        const double v = static_cast<double>(fall.at<float>(run.flakes.id[i]));
        const double tau = v / kGravity;
        EXPECT_NEAR(run.flakes.x[i], 20 + 2 * 3 + (-3 - 2) * tau, 2e-3);
        EXPECT_NEAR(run.flakes.y[i], 20 + 8 * tau, 2e-3);
        EXPECT_NEAR(run.flakes.z[i], 50 - v * 3 + (4 + v) * tau, 2e-3);
        EXPECT_EQ(run.flakes.slip_y[i], 0.0F);
    }
}

TEST(FlakeAdvector, LeavesTheTurbulenceAloneWhereThereIsNone)
{
    World w = world_with_everything(8000, OnLeave::wrap, false);
    TestRun run(w);
    run.steps(1);
    for (std::size_t i = 0; i < run->slots_used(); ++i) run.flakes.q1[i] = static_cast<float>(i);
    const std::vector<std::uint32_t> ids(run.flakes.id, run.flakes.id + run->slots_used());
    run.steps(1);
    const std::size_t same = std::min<std::size_t>(ids.size(), run->slots_used());
    for (std::size_t i = 0; i < same; ++i)
    {
        if (run.flakes.id[i] != ids[i] || (run.flakes.state[i] & 0xFFU) != 0) continue;
        ASSERT_EQ(std::abs(run.flakes.q1[i]), static_cast<float>(i));  // a wall may have mirrored it
    }
}

TEST(LogWind, FollowsTheLogarithmicProfile)
{
    Wind wind;
    wind.kind = WindKind::logarithmic;
    wind.friction_velocity_m_s = 0.37F;
    wind.roughness_m = 0.05F;
    wind.ground_m = 3;
    const LogWind field{surface_layer(wind), 0.6F, 0.8F};
    for (const double d : {-1.0, 0.0, 0.01, 0.05, 1.0, 10.0, 200.0})
    {
        const Vec3<double> u = field.mean(Vec3<double>{5, 5, 3 + d});
        const double z0 = static_cast<double>(wind.roughness_m);
        const double speed =
            d <= 0 ? 0 : static_cast<double>(wind.friction_velocity_m_s) / 0.4 * std::log((d + z0) / z0);
        EXPECT_NEAR(u.x, static_cast<double>(0.6F) * speed, 1e-6 * (speed + 1));
        EXPECT_NEAR(u.y, static_cast<double>(0.8F) * speed, 1e-6 * (speed + 1));
        EXPECT_EQ(u.z, 0);
    }
}

TEST(SurfaceLayer, HasTheStressesOfTheNeutralClosure)
{
    Wind wind;
    wind.friction_velocity_m_s = 0.4F;
    wind.boundary_layer_m = 800;
    for (const double angle : {0.0, 0.7, 2.5, 4.0})
    {
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        wind.to_x = static_cast<float>(c), wind.to_y = static_cast<float>(s);
        const SurfaceLayer layer = surface_layer(wind);
        for (const double d : {0.5, 10.0, 300.0})
        {
            Air<double> a;
            sample_surface_layer(layer, d, a);
            const double f2 = 0.16 * std::pow(1 - d / 800, 1.5);
            const double xx = a.s11 * a.s11;
            const double xy = a.s11 * a.s21;
            const double yy = a.s21 * a.s21 + a.s22 * a.s22;
            const double xz = a.s11 * a.s31;
            const double yz = a.s21 * a.s31 + a.s22 * a.s32;
            const double zz = a.s31 * a.s31 + a.s32 * a.s32 + a.s33 * a.s33;
            EXPECT_NEAR(c * c * xx + 2 * c * s * xy + s * s * yy, 6.25 * f2, 1e-5);  // along
            EXPECT_NEAR(s * s * xx - 2 * c * s * xy + c * c * yy, 4.0 * f2, 1e-5);   // across
            EXPECT_NEAR(zz, 1.69 * f2, 1e-6);
            EXPECT_NEAR(c * xz + s * yz, -f2, 1e-6);  // momentum goes down
            EXPECT_NEAR(-s * xz + c * yz, 0, 1e-6);
            Air<double> above;
            Air<double> below;
            sample_surface_layer(layer, d + 1e-3, above);
            sample_surface_layer(layer, d - 1e-3, below);
            EXPECT_NEAR(a.div_s.x, (above.s31 - below.s31) / 2e-3, 1e-7);
            EXPECT_NEAR(a.div_s.z, (above.s33 - below.s33) / 2e-3, 1e-7);
            const double c0_eps = 5.7 * 0.064 / (0.4 * d) * std::pow(1 - 0.85 * d / 800, 1.5);
            EXPECT_NEAR(a.c0_eps / c0_eps, 1, 1e-5);
        }
    }
}

/// Variance of the sum of n stationary AR(1) numbers with coefficient r, times h^2.
double spread(double r, double h, int n)
{
    double sum = n;
    double power = 1;
    for (int j = 1; j < n; ++j)
    {
        power *= r;
        sum += 2 * (n - j) * power;
    }
    return h * h * sum;
}

TEST(Turbulence, HasTheExactVarianceAndDiffusivityForEveryStepLength)
{
    constexpr int kFlakes = 8000;
    constexpr double kSigma = 0.7;
    for (const double a : {0.01, 0.1, 0.5, 1.0, 2.0, 5.0, 20.0})
    {
        const double h = 0.05;
        const double rate = a / h;
        const int n = a < 0.05 ? 300 : 120;
        World w = open_world(kFlakes, {2000, 2000, 200}, h);
        w.on_leave = OnLeave::remove;
        w.emitters[0].shape = EmitterShape::point;
        w.emitters[0].a = {1000, 1000, 150};
        w.wind = grid_wind(1, 1, 1, {0, 0, 0}, {1, 1, 1},
                           [&](float, float, float)
                           { return isotropic(static_cast<float>(kSigma), static_cast<float>(rate)); });
        TestRun run(w);
        run.steps(n);
        ASSERT_EQ(run->counts().alive, static_cast<std::uint64_t>(kFlakes));
        double variance = 0;
        double moved = 0;
        for (std::size_t i = 0; i < kFlakes; ++i)
        {
            for (const float* q : {run.flakes.q1, run.flakes.q2, run.flakes.q3})
                variance += static_cast<double>(q[i]) * static_cast<double>(q[i]) / (3.0 * kFlakes);
            const double dx = static_cast<double>(run.flakes.x[i]) - 1000;
            const double dy = static_cast<double>(run.flakes.y[i]) - 1000;
            moved += (dx * dx + dy * dy) / (2.0 * kFlakes);
        }
        EXPECT_NEAR(variance, 1, 4 * std::sqrt(2 / (3.0 * kFlakes))) << "a = " << a;
        const double r = (1 - a / 2) / (1 + a / 2);
        const double truth = kSigma * kSigma * spread(r, h, n);
        EXPECT_NEAR(moved / truth, 1, 4 * std::sqrt(2 / (2.0 * kFlakes))) << "a = " << a;
        // far field: 2 K t with K = sigma^2 T, the exact one, for every a; (1 - r^2) terms that do not grow
        // are left out
        if (n * a >= 60)
        {
            EXPECT_NEAR(truth / (2 * kSigma * kSigma / rate * (h * n)), 1, 2 / (n * std::min(a, 4 / a)))
                << "a = " << a;
        }
    }
}

struct WellMixed
{
    double entropy = 0;         ///< sum of p ln p, p = count / expected
    double variance_error = 0;  ///< root mean square over the bins of var q - 1
};

constexpr int kBins = 25;
constexpr int kMixed = 20000;

/// The sinusoid of the well-mixed test: sigma^2 = 1.1 + sin 2 pi x, C0 eps = 4 sigma^3, 12 s, periodic.
WellMixed sinusoid(double dt, bool substeps)
{
    World w = open_world(kMixed, {1, 1, 200}, dt);
    constexpr int kCells = 100;  // over one period; the grid goes half a period on, as half-way points do
    constexpr double kPi = std::numbers::pi;
    w.wind = grid_wind(2 * kCells + 1, 1, 1, {-0.5F, 0, 0}, {1.0F / kCells, 1, 1},
                       [&](float x, float, float)
                       {
                           const double phase = 2 * kPi * static_cast<double>(x);
                           const double sigma = std::sqrt(1.1 + std::sin(phase));
                           WindCell c{};
                           c.s11 = static_cast<float>(sigma);
                           c.div_s1 = static_cast<float>(kPi * std::cos(phase) / sigma);
                           c.c0_eps = static_cast<float>(4 * sigma * sigma * sigma);
                           c.gradient = substeps ? std::abs(c.div_s1) : 0;
                           return c;
                       });
    TestRun run(w, {0, Simd::automatic});
    run.steps(static_cast<int>(std::lround(12 / dt)));
    std::array<double, kBins> count{};
    std::array<double, kBins> square{};
    for (std::size_t i = 0; i < run->slots_used(); ++i)
    {
        const auto bin = static_cast<std::size_t>(run.flakes.x[i] * kBins);
        count[bin] += 1;
        square[bin] += static_cast<double>(run.flakes.q1[i]) * static_cast<double>(run.flakes.q1[i]);
    }
    WellMixed result;
    for (std::size_t b = 0; b < kBins; ++b)
    {
        const double p = count[b] * kBins / kMixed;
        if (p > 0) result.entropy += p * std::log(p);
        const double error = square[b] / count[b] - 1;
        result.variance_error += error * error / kBins;
    }
    result.variance_error = std::sqrt(result.variance_error);
    return result;
}

// noise: B (B - 1) / 2N, and its fivefold standard deviation; variance per bin: sqrt(2 B / N)
const double kEntropyMark =
    kBins * (kBins - 1) / (2.0 * kMixed) + 5 * kBins * std::sqrt(2.0 * (kBins - 1)) / (2.0 * kMixed);
const double kVarianceMark = 1.5 * std::sqrt(2.0 * kBins / kMixed);

TEST(Turbulence, KeepsTheSinusoidWellMixed)
{
    for (const double dt : {0.02, 0.05, 0.1, 0.2, 0.4})
    {
        const WellMixed result = sinusoid(dt, true);
        RecordProperty("entropy_" + std::to_string(dt), std::to_string(result.entropy));
        EXPECT_LT(result.entropy, kEntropyMark) << "dt = " << dt;
        EXPECT_LT(result.variance_error, kVarianceMark) << "dt = " << dt;
    }
}

TEST(Turbulence, NeedsTheGradientLimitForThat)
{
    const WellMixed result = sinusoid(0.4, false);
    EXPECT_GT(result.entropy, 5 * kEntropyMark);
    EXPECT_GT(result.variance_error, 3 * kVarianceMark);
}

TEST(Substeps, FollowGradientAndStepAndAreBounded)
{
    EXPECT_EQ(substeps(0.0F, 1.0F), 1);
    EXPECT_EQ(substeps(1.4F, 0.1F), 1);
    EXPECT_EQ(substeps(1.6F, 0.1F), 2);
    EXPECT_EQ(substeps(10.0F, 0.1F), 7);
    EXPECT_EQ(substeps(1e30F, 1.0F), kMostSubsteps);
}

TEST(Relaxations, FollowTheSteepestPlaceAndAreBounded)
{
    EXPECT_EQ(relaxations(0, 1), 1);
    EXPECT_EQ(relaxations(5.9, 0.1), 1);
    EXPECT_EQ(relaxations(6.1, 0.1), 2);
    EXPECT_EQ(relaxations(1e30, 1), kMostRelaxations);
    World w = open_world(1, {1, 1, 1}, 1);
    w.wind = grid_wind(5, 1, 1, {0, 0, 0}, {1, 1, 1},
                       [](float x, float, float)
                       {
                           WindCell c{};
                           c.gradient = x == 3 ? 1.5F : 0.1F;
                           return c;
                       });
    EXPECT_EQ(relaxations(w), 3);
    Wind::State later{1.0, w.wind.cells};
    later.cells[0].gradient = 2;
    w.wind.later = {later};
    EXPECT_EQ(relaxations(w), 4) << "at any time";
    w.wind.turbulent = false;
    EXPECT_EQ(relaxations(w), 1);
    w.wind.turbulent = true;
    w.wind.kind = WindKind::logarithmic;
    w.wind.friction_velocity_m_s = 2, w.wind.boundary_layer_m = 20;
    w.size_m.z = 100, w.step_s = 10;
    EXPECT_EQ(relaxations(w), 9);  // 3/4 u*/zi 2.5 (1.01 / 50)^(-1/4) = 0.497 1/s
}

}  // namespace
}  // namespace spindrift::cpu::test
