// SPDX-License-Identifier: MIT
// Rows 2, 3 and 4: flakes that are spread evenly stay so where the turbulence varies.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/wind.h"
#include "tests/stress/tracers.h"

namespace spindrift::stress
{
namespace
{

/// Whether steps are cut where the turbulence varies.
enum class Cutting
{
    by_gradient,
    never,
};

/// sigma(x) along x over one period of 1 m, C0 eps = 4 sigma^3.
template <class Sigma, class Slope>
Wind periodic_air(int cells, Cutting cutting, const Sigma& sigma, const Slope& slope)
{
    return cpu::test::grid_wind(2 * cells + 1, 1, 1, {-0.5F, 0, 0}, {1.0F / static_cast<float>(cells), 1, 1},
                                [&](float x, float, float)
                                {
                                    const double s = sigma(static_cast<double>(x));
                                    WindCell c{};
                                    c.s11 = static_cast<float>(s);
                                    c.s22 = c.s33 = 0.1F;
                                    c.div_s1 = static_cast<float>(slope(static_cast<double>(x)));
                                    c.c0_eps = static_cast<float>(4 * s * s * s);
                                    c.gradient = cutting == Cutting::never ? 0 : std::abs(c.div_s1);
                                    c.w = fall_speed();
                                    return c;
                                });
}

Bins mix(const Wind& wind, std::uint64_t flakes, double dt, double seconds, std::size_t bins)
{
    World w = tracer_world(flakes, {1, 1, 100}, dt);
    w.emitters[0].a.z = 40, w.emitters[0].b.z = 60;
    w.wind = wind;
    TestRun run(w);
    run.steps(static_cast<int>(std::lround(seconds / dt)));
    EXPECT_EQ(run->counts().alive, flakes);
    EXPECT_EQ(run->extent().rogue, 0U) << "dt = " << dt;
    Bins result(bins);
    for (const std::size_t i : living(run))
        result.add(static_cast<double>(run.flakes.x[i]), static_cast<double>(run.flakes.q1[i]));
    return result;
}

double sine_sigma(double x)
{
    return std::sqrt(1.1 + std::sin(2 * std::numbers::pi * x));
}
double sine_slope(double x)
{
    return std::numbers::pi * std::cos(2 * std::numbers::pi * x) / sine_sigma(x);
}

/// Row 2: Bailey's sinusoid. Entropy and the variance in every bin together: at large steps an entropy alone
/// is right for any scheme.
TEST(WellMixed, SinusoidForAnyStep)
{
    for (const double dt : {0.01, 0.1, 1.0, 4.0})
    {
        const Bins bins =
            mix(periodic_air(100, Cutting::by_gradient, sine_sigma, sine_slope), 5000, dt, 12, 25);
        EXPECT_LT(bins.entropy(), bins.entropy_mark()) << "dt = " << dt;
        EXPECT_LT(bins.variance_error(), bins.variance_mark()) << "dt = " << dt;
    }
}

/// Row 2: homogeneous air, most of which asks for four sub-steps where the rest takes one: none of it gains
/// flakes. A step is as long as the turbulence's own time.
TEST(WellMixed, NoSeamWhereTwoNumbersOfSubstepsMeet)
{
    constexpr double kSigma = 0.5, kStep = 0.1;
    Wind wind = periodic_air(
        100, Cutting::never, [](double) { return kSigma; }, [](double) { return 0.0; });
    for (std::size_t i = 0; i < wind.cells.size(); ++i)
    {
        wind.cells[i].c0_eps = static_cast<float>(2 * kSigma * kSigma / kStep);
        if (i % 100 < 50) wind.cells[i].gradient = 5.9F;
    }
    const Bins bins = mix(wind, 20000, kStep, 6, 20);
    EXPECT_LT(bins.chi_square(), bins.chi_square_mark());
    EXPECT_LT(bins.variance_error(), bins.variance_mark());
}

/// Row 4: sigma goes from 0.2 to 2 m/s within a twentieth of the period and back. Over the cells it is
/// linear, and the air stays mixed; taken from the nearest cell, whose S has no slope, flakes gather where it
/// is calm.
TEST(WellMixed, AStepOfSigmaByTenIsNoTrap)
{
    constexpr double kWidth = 0.05;
    const auto ramp = [](double x)
    {
        const double at = x - std::floor(x);  // up at 1/4, down at 3/4
        return std::clamp((0.25 + kWidth / 2 - std::abs(at - 0.5)) / kWidth, 0.0, 1.0);
    };
    const auto sigma = [&](double x) { return 0.2 + 1.8 * ramp(x); };
    const auto slope = [&](double x)
    {
        const double share = ramp(x), at = x - std::floor(x);
        return share <= 0 || share >= 1 ? 0.0 : (at < 0.5 ? 1.8 : -1.8) / kWidth;
    };
    const Bins good = mix(periodic_air(200, Cutting::by_gradient, sigma, slope), 6000, 0.05, 10, 20);
    EXPECT_LT(good.entropy(), 2 * good.entropy_mark());
    const auto step = [&](double x) { return ramp(x) < 0.5 ? 0.2 : 2.0; };
    const auto none = [](double) { return 0.0; };
    const Bins nearest = mix(periodic_air(200, Cutting::never, step, none), 6000, 0.05, 10, 20);
    EXPECT_GT(nearest.entropy(), 10 * good.entropy_mark());
    RecordProperty("entropy_linear", std::to_string(good.entropy()));
    RecordProperty("entropy_nearest", std::to_string(nearest.entropy()));
}

/// Row 3: the neutral surface layer between a ground and a lid that mirror. The time of the turbulence goes
/// to nothing towards the ground; u'w' is -u*^2 at every height.
TEST(WellMixed, SurfaceLayerDownToItsRoughness)
{
    constexpr double kFriction = 0.4, kDepth = 20;
    for (const auto& [dt, seconds] :
         {std::pair(2e-3, 0.6), std::pair(0.02, 5.0), std::pair(0.2, 30.0), std::pair(1.0, 60.0)})
    {
        constexpr std::uint64_t kFlakes = 6000;
        World w = tracer_world(kFlakes, {40, 40, 39}, dt);
        w.has_ground = true;
        w.ground = {Contact::bounce, 1};
        w.voxels = cpu::test::voxels(
            2, 2, 2, kDepth, [](int, int, int z) { return z == 1; },
            [](int, int, int) { return std::uint8_t{0}; });
        w.surfaces = {{Contact::bounce, 1}};
        w.emitters[0].b.z = 20;
        w.wind.kind = WindKind::uniform;
        w.wind.turbulent = true;
        w.wind.uniform_m_s = {0, 0, fall_speed()};
        w.wind.friction_velocity_m_s = static_cast<float>(kFriction);
        w.wind.roughness_m = 0.02F;
        w.wind.boundary_layer_m = 1e6F;
        TestRun run(w);
        run.steps(static_cast<int>(std::lround(seconds / dt)));
        ASSERT_EQ(run->counts().alive, kFlakes);
        ASSERT_EQ(run->extent().rogue, 0U);
        const SurfaceLayer layer = surface_layer(w.wind);
        Bins bins(10);
        for (const std::size_t i : living(run))
        {
            Air<float> air;
            sample_surface_layer(layer, run.flakes.z[i], air);
            const Vec3f u =
                turbulent_velocity(air, Vec3f{run.flakes.q1[i], run.flakes.q2[i], run.flakes.q3[i]});
            bins.add(static_cast<double>(run.flakes.z[i]) / kDepth, static_cast<double>(u.x),
                     static_cast<double>(u.z));
        }
        EXPECT_LT(bins.chi_square(), bins.chi_square_mark()) << "dt = " << dt;
        const double f2 = kFriction * kFriction;
        for (std::size_t b = 0; b < bins.size(); ++b)
            EXPECT_NEAR(bins.mean_product(b), -f2, 5 * f2 * std::sqrt((6.25 * 1.69 + 1) / bins.count(b)))
                << "dt = " << dt << ", bin " << b;
        EXPECT_NEAR(bins.count(0), kFlakes / 10.0, 5 * std::sqrt(kFlakes / 10.0))
            << "at the ground, dt = " << dt;
    }
}

}  // namespace
}  // namespace spindrift::stress
