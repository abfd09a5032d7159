// SPDX-License-Identifier: MIT
// Row 7: a scene far from the origin, and steps so short that they vanish in the last place of a coordinate.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cpu/wind_projection.h"
#include "scene/make_world.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "tests/stress/tracers.h"

namespace spindrift::stress
{
namespace
{

/// Every kind of place that a scene may name, `far` metres from the origin on each axis.
World far_world(double far)
{
    const auto at = [&](double x, double y, double z)
    { return fmt::format("[{:.3f}, {:.3f}, {:.3f}]", far + x, far + y, far + z); };
    const std::string text =
        "[scene]\nstep_s = 0.05\n[domain]\nmin_m = " + at(0, 0, 0) + "\nmax_m = " + at(40, 30, 20) +
        "\n[particles]\ncapacity = 3000\n[ground]\nkind = \"plane\"\nheight_m = " +
        fmt::format("{:.1f}", far + 0.5) +
        "\ncontact = \"bounce\"\n[wind]\nsource = \"log\"\nspeed_m_s = 8\naround_solids = true\n"
        "[[box]]\nmin_m = " +
        at(12, 8, 0) + "\nmax_m = " + at(18, 16, 9) + "\ncontact = \"bounce\"\n" +
        "[[vehicle]]\nname = \"van\"\n[[vehicle.key]]\nposition_m = " + at(10, 10, 6) +
        "\n[[vehicle.key]]\ntime_s = 2\nposition_m = " + at(25, 20, 6) +
        "\n[[emitter]]\nshape = \"box\"\nmin_m = " + at(1, 1, 1) + "\nmax_m = " + at(39, 29, 19) +
        "\nburst = 1000\n[[emitter]]\nshape = \"point\"\nat_m = " + at(5.25, 15, 3.125) +
        "\nrate_per_s = 200\n[[emitter]]\nshape = \"plane\"\ncorner_m = " + at(0.5, 0, 1) +
        "\nedge_u_m = [0, 30, 0]\nedge_v_m = [0, 0, 12]\nburst = 300\n"
        "[[emitter]]\nshape = \"sky\"\nfollows = \"van\"\nsize_m = [10, 10, 10]\nburst = 500\n"
        "[[camera.key]]\neye_m = " +
        at(0, -10, 5) + "\nlook_at_m = " + at(20, 15, 5) + "\n";
    const scene::Scene scene = scene::parse_scene(text, "far.toml");
    return make_world(scene, scene::read_geometry(scene), cpu::project_wind());
}

TEST(FarAway, ASceneIsTheSameToTheLastBit)
{
    std::uint64_t near_hash = 0;
    for (const double far : {0.0, 1e2, 1e4, 1e6, 1e8 - 100})
    {
        TestRun run(far_world(far));
        run.steps(40);
        const FlakeCounts c = run->counts();
        ASSERT_GT(c.alive, 1000U);
        ASSERT_EQ(c.emitted, c.alive + c.left + c.landed + c.vanished);
        if (near_hash == 0) near_hash = run->state_hash();
        EXPECT_EQ(run->state_hash(), near_hash) << far << " m from the origin";
    }
}

/// 0.7 km from the corner of a domain a step of 1e-4 s is less than a last place: rounded as usual, a flake
/// would never move, or three times too fast.
TEST(FarAway, StepsBelowTheLastPlaceMoveFlakesOnAverage)
{
    constexpr std::uint64_t kFlakes = 2000;
    constexpr int kSteps = 300;
    constexpr double dt = 1e-4, kPlace = 0x1p-14;  // of 512 to 1024 m
    for (const float speed : {0.25F, 0.45F, 1.0F})
    {
        World w = tracer_world(kFlakes, {1000, 1000, 1000}, dt);
        w.wind.uniform_m_s = {speed, -speed, fall_speed()};
        w.emitters[0].shape = EmitterShape::point;
        w.emitters[0].a = {700, 700, 700};
        TestRun run(w);
        run.steps(kSteps);
        double x = 0, y = 0, z = 0;
        for (std::size_t i = 0; i < kFlakes; ++i)
        {
            x += (static_cast<double>(run.flakes.x[i]) - 700) / kFlakes;
            y += (static_cast<double>(run.flakes.y[i]) - 700) / kFlakes;
            z += (static_cast<double>(run.flakes.z[i]) - 700) / kFlakes;
        }
        const double way = static_cast<double>(speed) * dt * kSteps;
        const double noise = 0.5 * kPlace * std::sqrt(static_cast<double>(kSteps) / kFlakes);
        EXPECT_NEAR(x, way, 5 * noise);
        EXPECT_NEAR(y, -way, 5 * noise);
        EXPECT_NEAR(z, 0, 5 * noise);
    }
}

}  // namespace
}  // namespace spindrift::stress
