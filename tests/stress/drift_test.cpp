// SPDX-License-Identifier: MIT
// Snow that the wind takes up from the ground.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/drift.h"
#include "core/error.h"
#include "core/snow.h"
#include "cpu/wind_projection.h"
#include "scene/make_world.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "tests/stress/tracers.h"

namespace spindrift::stress
{
namespace
{

World drifting(double friction, const std::string& more = "", const std::string& emitter = "")
{
    const std::string text = fmt::format(
        "[scene]\nstep_s = 0.01\n[domain]\nmin_m = [0, 0, 0]\nmax_m = [60, 20, 10]\non_leave = \"wrap\"\n"
        "[particles]\ncapacity = 60000\n[snow]\nweight = 1e6\n[ground]\nkind = \"plane\"\n[wind]\nsource = "
        "\"log\"\n"
        "friction_velocity_m_s = {}\nroughness_m = 0.001\n{}"
        "[[emitter]]\nshape = \"drift\"\nmin_m = [10, 0, 0]\nmax_m = [30, 20, 3]\n{}"
        "[[camera.key]]\neye_m = [0, -10, 5]\nlook_at_m = [20, 15, 5]\n",
        friction, more, emitter);
    const scene::Scene scene = scene::parse_scene(text, "drift.toml");
    return make_world(scene, scene::read_geometry(scene), cpu::project_wind());
}

/// Figures worked by hand from Pomeroy and Gray's flux.
TEST(Drift, HasTheSaltationOfPomeroyAndGray)
{
    const Saltation s = saltation(0.6, 0.25);
    EXPECT_NEAR(s.flux_kg_m_s, 0.68 * 1.2 / 9.80665 * (0.25 / 0.6) * (0.36 - 0.0625), 1e-9);
    EXPECT_NEAR(s.height_m, 0.0441, 1e-4);
    EXPECT_NEAR(s.snow_kg_m3, 0.334, 1e-3);
    EXPECT_EQ(saltation(0.25, 0.25).flux_kg_m_s, 0);
    EXPECT_EQ(saltation(0.1, 0.25).height_m, 0);
    // what leaves the ground falls back to it: mean of w over mass, times the snow in the layer
    const GrainLaw law{5, 2e-5};
    EXPECT_NEAR(grain_moment(law, 3) / (8e-15 * 5 * 6 * 7), 1, 1e-5);
    EXPECT_NEAR(grain_moment(law, 1) / 1e-4, 1, 1e-5);
}

TEST(Drift, BeginsAboveTheThreshold)
{
    const World calm = drifting(0.24);
    EXPECT_EQ(calm.emitters[0].rate_per_s, 0);
    TestRun still(calm);
    still.steps(20);
    EXPECT_EQ(still->counts().emitted, 0U);
    const World loose = drifting(0.24, "", "threshold_friction_velocity_m_s = 0.2\n");
    EXPECT_GT(loose.emitters[0].rate_per_s, 0);
    double before = 0;
    for (const double friction : {0.26, 0.3, 0.4, 0.6})
    {
        const World w = drifting(friction);
        EXPECT_GT(w.emitters[0].rate_per_s, before);
        before = w.emitters[0].rate_per_s;
    }
    const World w = drifting(0.6);
    const Saltation layer = saltation(0.6, 0.25);
    const double flake = 1e6 * mean_cross_section_m2(w.snow.spectrum, 1.0);
    const double truth = 20 * 20 * lifted_per_s(layer, grain_law(layer.height_m)) / flake;
    EXPECT_NEAR(w.emitters[0].rate_per_s / truth, 1, 1e-6);
    TestRun run(w);
    run.steps(100);
    EXPECT_EQ(run->counts().emitted, static_cast<std::uint64_t>(w.emitters[0].rate_per_s * 0.01 * 100));
    EXPECT_EQ(misplaced(w, run), 0U);
}

TEST(Drift, LeapsEvenlyOutOfItsGround)
{
    World w = drifting(0.6);
    w.emitters[0].rate_per_s = 2e4 / w.step_s;
    w.wind.turbulent = false;
    w.step_s = 1e-4;
    w.emitters[0].rate_per_s = 1e8;
    TestRun run(w);
    run.steps(3);  // those of the first step hang in the air
    Bins along(20), across(20), up(20);
    for (const std::size_t i : living(run))
    {
        if (run.flakes.id[i] < 10000) continue;
        along.add((static_cast<double>(run.flakes.x[i]) - 10) / 20);
        across.add(static_cast<double>(run.flakes.y[i]) / 20);
        ASSERT_LE(run.flakes.z[i], w.emitters[0].radius_m * 1.001F);
        ASSERT_GE(run.flakes.z[i], 0);
    }
    EXPECT_LT(along.chi_square(), along.chi_square_mark());
    EXPECT_LT(across.chi_square(), across.chi_square_mark());
}

/// At the start grains of one speed w hang as z^(-w / b): the share below their height is uniform.
TEST(Drift, HangsInTheAirByTheSpeedOfItsGrains)
{
    World w = drifting(0.6, "", "burst = 20000\n");
    w.emitters[0].rate_per_s = 0;
    w.wind.turbulent = false;
    w.step_s = 1e-4;
    TestRun run(w);
    run->step();
    FallSpeed fall(w.snow, w.seed);
    fall.first_drift = 0, fall.grains = GrainSpeed(w.grains);
    Bins share(20);
    const double low = static_cast<double>(w.emitters[0].radius_m), high = 3;
    EXPECT_NEAR(w.emitters[0].lift_m_s, 1.353 * 0.4 * 0.6, 1e-3);
    double lightest = 10, heaviest = 0;
    for (const std::size_t i : living(run))
    {
        const double v = static_cast<double>(fall.at<float>(run.flakes.id[i], 0U));
        const double power = 1 - v / static_cast<double>(w.emitters[0].lift_m_s);
        const double z = static_cast<double>(run.flakes.z[i]) + v * w.step_s;
        share.add((std::pow(z / low, power) - 1) / (std::pow(high / low, power) - 1));
        lightest = std::min(lightest, v), heaviest = std::max(heaviest, v);
    }
    EXPECT_LT(share.chi_square(), share.chi_square_mark());
    EXPECT_LT(lightest, 0.4);
    EXPECT_GT(heaviest, 2);
}

/// Over ground that lets go as much as it takes the layer near it fills to the snow that saltation has there,
/// and does not go on to fill.
TEST(Drift, ComesToABalanceWithTheGround)
{
    World w = drifting(0.5);
    w.emitters[0].a = {0, 0, 0}, w.emitters[0].b = {60, 20, 3};
    w.emitters[0].rate_per_s = 4e4;
    TestRun run(w);
    run.steps(100);
    const double early = static_cast<double>(run->counts().alive);
    run.steps(100);
    const FlakeCounts c = run->counts();
    EXPECT_GT(c.landed, c.emitted / 2);
    EXPECT_EQ(c.emitted, c.alive + c.left + c.landed + c.vanished);
    EXPECT_LT(static_cast<double>(c.alive), 1.9 * early);
    EXPECT_EQ(misplaced(w, run), 0U);
}

TEST(Drift, RefusesWhereNothingCanDrift)
{
    const auto error_of = [](const std::string& more, const std::string& emitter)
    {
        try
        {
            drifting(0.6, more, emitter);
        }
        catch (const Error& error)
        {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(error_of("", ""), "");
    EXPECT_NE(error_of("", "rate_per_s = 5\n").find("rate_per_s"), std::string::npos);
    EXPECT_NE(error_of("[[emitter]]\nshape = \"drift\"\nmin_m = [1, 1, 1]\nmax_m = [2, 2, 2]\n", "")
                  .find("emitter 1: a drift stands on plane ground"),
              std::string::npos);
}

}  // namespace
}  // namespace spindrift::stress
