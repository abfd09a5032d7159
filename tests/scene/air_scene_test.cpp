// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/air.h"
#include "scene/make_world.h"
#include "tests/scene/small_scene.h"

namespace spindrift::scene
{
namespace
{

using testing::HasSubstr;

constexpr std::string_view kSky =
    "[[emitter]]\nshape = \"sky\"\ncentre_m = [5, 5, 4]\nsize_m = [20, 6, 10]\nburst = 900\n";

TEST(AirSettings, StateTheSameExtinctionInManyWays)
{
    EXPECT_EQ(uniform_extinction(parse(kSmallScene)), 0);
    const auto of = [](const std::string& air) { return uniform_extinction(parse(with("[air]\n" + air))); };
    EXPECT_NEAR(of("source = \"visibility\"\nvisibility_m = 300\n"), 2.995732 / 300, 1e-8);
    EXPECT_NEAR(of("source = \"visibility\"\nvisibility_m = 300\ncontrast = \"2%\"\n"), 3.912023 / 300, 1e-8);
    EXPECT_NEAR(of("source = \"concentration\"\nsnow_g_m3 = 1\n"), 10.36e-3, 1e-9);
    EXPECT_NEAR(of("source = \"particle-rate\"\nparticles_per_s = 0\n"), 2.995732 / 600, 1e-8);
    EXPECT_NEAR(of("source = \"particle-rate\"\nparticles_per_s = 9e5\nfit = \"legacy\"\n"), 2.995732, 1e-5);
    const Scene snowfall = parse(with("[snow]\nrate_mm_h = 3\n[air]\nsource = \"snowfall\"\n"));
    EXPECT_NEAR(uniform_extinction(snowfall), extinction_of_snowfall(snowfall.snow), 1e-12);
}

TEST(AirSettings, OfTheFlakesIsTheirNumberTimesTheirArea)
{
    const Scene scene = parse(with(std::string(kSky) + "[air]\nsource = \"flakes\"\n"));
    // the sky's box cut at the domain and the ground: 10 x 6 x 9 m
    EXPECT_NEAR(uniform_extinction(scene), 900 / 540.0 * full_flake_area_m2(scene.render, scene.snow), 1e-12);
    const Air air = air_at(scene, camera_at(scene, 0), 0);
    EXPECT_NEAR(air.flakes_per_m3, 900 / 540.0, 1e-9);
    EXPECT_EQ(air.low.x, 0);
    EXPECT_EQ(air.high.z, 9);
}

TEST(AirSettings, AreRefusedWhereTheyMakeNoSense)
{
    const auto error = [](const std::string& more) { return error_of(with(more)); };
    EXPECT_THAT(error("[air]\nsource = \"visibility\"\n"), HasSubstr("visibility_m"));
    EXPECT_THAT(error("[air]\nsource = \"visibility\"\nvisibility_m = 0\n"), HasSubstr("use 1 to"));
    EXPECT_THAT(error("[air]\nvisibility_m = 100\n"), HasSubstr("with source = \"visibility\""));
    EXPECT_THAT(error("[air]\nsource = \"flakes\"\n"), HasSubstr("use exactly one [[emitter]]"));
    EXPECT_THAT(error("[air]\nlaw = \"legacy\"\n"), HasSubstr("thick air"));
    EXPECT_THAT(error("[air]\ndrift_height_m = 2\n"), HasSubstr("with drift_visibility_m"));
    EXPECT_THAT(error("[air]\ndrift_visibility_m = 50\nlaw = \"legacy\"\n"), HasSubstr("has no height"));
    const std::string two =
        std::string(kSky) +
        "[[emitter]]\nshape = \"sky\"\ncentre_m = [5, 5, 4]\nsize_m = [2, 2, 2]\nburst = 9\n";
    EXPECT_EQ(error(two), "");
    EXPECT_THAT(error(two + "[air]\nsource = \"snowfall\"\n"), HasSubstr("at most one"));
}

TEST(PhaseSettings, AreRefusedWhereTheyAreSingularOrMeanNothing)
{
    const std::string light =
        "[[light]]\nkind = \"point\"\nposition_m = [1, 1, 1]\nintensity_w_sr = [1, 1, 1]\n";
    const auto error = [&](const std::string& more) { return error_of(with(light + more)); };
    EXPECT_EQ(error("phase = \"schlick\"\ng = 0.93\n"), "");
    EXPECT_THAT(error("phase = \"schlick\"\ng = 0.95\n"), HasSubstr("pole"));
    EXPECT_THAT(error("phase = \"schlick\"\ng = -0.95\n"), HasSubstr("pole"));
    EXPECT_EQ(error("g = 0.95\n"), "");
    EXPECT_THAT(error("g_back = -0.5\n"), HasSubstr("with phase = \"double\""));
    EXPECT_EQ(error("phase = \"double\"\nback_share = 0.2\n"), "");
    EXPECT_NEAR(parse(with(light + "phase = \"double\"\n")).lights[0].g, 0.889, 1e-12);
}

TEST(FlakeShade, FullAreaIsThatOfAFlakeNeitherNearNorTiny)
{
    RenderSettings render;
    render.flake_scale = 20;
    Snow snow;
    snow.weight = 400;
    View view;
    view.guard_px = 128;
    const double full = full_flake_area_m2(render, snow);
    EXPECT_NEAR(flake_area_m2(render, snow, view, 10) / full, 1, 0.01);
    EXPECT_EQ(flake_area_m2(render, snow, view, 0.05), 0);
    EXPECT_LT(flake_area_m2(render, snow, view, 3000), 0.01 * full);
    const FlakeShadeTable table = make_flake_shade(render, snow, view, 1);
    EXPECT_NEAR(table.view().area_at(10) / full, 1, 0.01);
    // the integral's derivative is the area
    const double change = table.view().integral_to(12) - table.view().integral_to(8);
    EXPECT_NEAR(change / (4 * full), 1, 0.01);
    const FlakeShadeTable capped = make_flake_shade(render, snow, view, 0.5 * full);
    EXPECT_NEAR(capped.view().area_at(10), 0.5 * full, 1e-12);
    render.blending = Blending::additive;
    EXPECT_EQ(full_flake_area_m2(render, snow), 0);
}

TEST(FarTransmittance, LooksAlongTheCornersToo)
{
    const Scene level = parse(with("[air]\nsource = \"visibility\"\nvisibility_m = 1e6\n"));
    const View view = camera_at(level, 0);
    EXPECT_GT(far_transmittance(level, view), 0.995);
    EXPECT_LT(far_transmittance(level, view), 1);
    const Scene drifting = parse(with("[air]\ndrift_visibility_m = 50\ndrift_height_m = 0.05\n"));
    EXPECT_LT(far_transmittance(drifting, view), 0.995) << "the lower corners look into the drift";
    EXPECT_EQ(far_transmittance(parse(kSmallScene), view), 1);
}

}  // namespace
}  // namespace spindrift::scene
