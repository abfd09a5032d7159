// SPDX-License-Identifier: MIT
// Rows 8 and 10: how many flakes come into being, where, and what comes after those that left.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/stress/tracers.h"

namespace spindrift::stress
{
namespace
{

/// Row 8: rates that no step divides are exact in the long run.
TEST(Emission, MakesItsRateForAnyStep)
{
    for (const double dt : {1e-4, 0.0173, 1.0 / 60, 0.37, 10.0})
        for (const double rate : {0.01, 1.7, 123.456})
        {
            World w = tracer_world(20000, {10, 10, 10}, dt);
            w.wind.uniform_m_s = {0, 0, fall_speed()};
            w.emitters[0].burst = 0;
            w.emitters[0].rate_per_s = rate;
            TestRun run(w);
            constexpr int kSteps = 15;
            run.steps(kSteps);
            EXPECT_EQ(run->counts().emitted, static_cast<std::uint64_t>(rate * dt * kSteps));
            EXPECT_EQ(run->counts().withheld, 0U);
        }
}

/// Row 8: of a box that solids fill to a half only the free half holds flakes, and that evenly.
TEST(Emission, FillsWhatSolidsLeaveOfItsShape)
{
    World w = tracer_world(20000, {8, 8, 8}, 1e-4);
    w.wind.uniform_m_s = {0, 0, fall_speed()};
    w.voxels = cpu::test::voxels(
        8, 8, 8, 1, [](int x, int, int) { return x % 2 == 1; },
        [](int, int, int) { return std::uint8_t{0}; });
    w.surfaces = {{Contact::bounce, 1}};
    TestRun run(w);
    run->step();
    EXPECT_EQ(misplaced(w, run), 0U);
    const FlakeCounts c = run->counts();
    EXPECT_EQ(c.emitted, c.alive + c.vanished);
    const double lost = 20000.0 / 256;  // eight places in a row inside
    EXPECT_NEAR(static_cast<double>(c.vanished), lost, 5 * std::sqrt(lost));
    Bins along(20), across(20);
    for (const std::size_t i : living(run))
    {
        const double x = static_cast<double>(run.flakes.x[i]);
        along.add((std::floor(x / 2) + std::min(x - 2 * std::floor(x / 2), 1.0)) / 4);
        across.add(static_cast<double>(run.flakes.z[i]) / 8);
    }
    EXPECT_LT(along.chi_square(), along.chi_square_mark());
    EXPECT_LT(across.chi_square(), across.chi_square_mark());
}

/// Row 8: a sphere is covered evenly (height and azimuth are uniform), not a cube pressed onto it.
TEST(Emission, CoversASphereEvenly)
{
    World w = tracer_world(20000, {8, 8, 8}, 1e-4);
    w.wind.uniform_m_s = {0, 0, fall_speed()};
    w.emitters[0].shape = EmitterShape::sphere_surface;
    w.emitters[0].a = {4, 4, 4};
    w.emitters[0].radius_m = 3;
    TestRun run(w);
    run->step();
    Bins height(20), azimuth(20);
    for (const std::size_t i : living(run))
    {
        const Vec3f d = Vec3f{run.flakes.x[i], run.flakes.y[i], run.flakes.z[i]} - w.emitters[0].a;
        ASSERT_NEAR(std::sqrt(dot(d, d)), 3, 1e-4);
        height.add(static_cast<double>(d.z) / 6 + 0.5);
        azimuth.add(std::atan2(static_cast<double>(d.y), static_cast<double>(d.x)) / 6.283185307 + 0.5);
    }
    EXPECT_LT(height.chi_square(), height.chi_square_mark());
    EXPECT_LT(azimuth.chi_square(), azimuth.chi_square_mark());
}

/// Row 10: what leaves is made anew upwind, one for one, and what comes in there is spread evenly.
TEST(Respawn, KeepsTheNumberAndAnEvenInflow)
{
    for (const double dt : {0.02, 0.5})
    {
        World w = tracer_world(4000, {20, 8, 8}, dt);
        w.on_leave = OnLeave::respawn;
        w.wind.uniform_m_s = {15, 0, fall_speed()};
        Emitter& e = w.emitters[0];
        e.shape = EmitterShape::plane;
        e.a = {0.5F, 0, 0}, e.b = {0.5F, 8, 0}, e.c = {0.5F, 0, 8};
        TestRun run(w);
        Bins across(20), up(20);
        std::uint64_t left = 0;
        for (int i = 0; i < 200; ++i)
        {
            run->step();
            const FlakeCounts c = run->counts();
            ASSERT_EQ(c.emitted, 4000 + left) << "step " << i;
            ASSERT_EQ(c.emitted, c.alive + c.left);
            left = c.left;
        }
        ASSERT_GT(left, 8000U);
        for (const std::size_t i : living(run))
        {
            across.add(static_cast<double>(run.flakes.y[i]) / 8);
            up.add(static_cast<double>(run.flakes.z[i]) / 8);
        }
        EXPECT_LT(across.chi_square(), across.chi_square_mark());
        EXPECT_LT(up.chi_square(), up.chi_square_mark());
    }
}

}  // namespace
}  // namespace spindrift::stress
