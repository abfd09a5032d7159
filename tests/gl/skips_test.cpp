// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "scene/mesh.h"
#include "tests/gl/stage.h"

namespace spindrift::gl
{
namespace
{

/// A stage, drawn frame by frame with plans that a test may change.
struct Skips : testing::Test, Stage
{
    FrameStats stats;

    Skips()
    {
        scene.sky = {{0.1F, 0.2F, 0.4F}, {0.4F, 0.3F, 0.2F}, {0.3F, 0.3F, 0.3F}};
        scene.display.dither = false;
        scene.render.flake_scale = 6;
        world.snow.weight = 36;
        for (std::uint32_t i = 0; i < 300; ++i)
            add_flake({0.02F * static_cast<float>(i % 17) - 0.15F, 9 - 0.02F * static_cast<float>(i),
                       0.02F * static_cast<float>(i % 11) - 0.1F},
                      i);
        stats.counts.alive = places.size();
        stats.brightest_emission = 0;
    }

    FramePlan plan() const { return plan_frame(scene, view, stats, 0, geometry.model_lights); }

    struct Pictures
    {
        image::Image linear;
        image::Image8 display;
        bool found_bright;
    };

    Pictures draw_planned(const FramePlan& frame, bool near_to_far = false) const
    {
        test_context();
        const FlakeBuffers buffers(std::max<std::size_t>(places.size(), 1));
        const FlakeView flakes = buffers.flakes();
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            flakes.x[i] = places[i].x;
            flakes.y[i] = places[i].y;
            flakes.z[i] = places[i].z;
            flakes.id[i] = ids[i];
            const std::size_t rank = near_to_far ? places.size() - 1 - i : i;
            buffers.draw_list().pairs[rank] = rank << 32 | i;
        }
        DrawList list;
        list.count = places.size();
        Renderer renderer(scene, geometry, world, buffers, view.width_px, view.height_px);
        renderer.draw(frame, view, list, 0);
        return {renderer.read_linear(), renderer.read_display(), renderer.found_bright()};
    }

    /// The plan leaves `name` out; drawn all the same, it changes no bit of the picture.
    void expect_nothing_lost(const std::string& name) const
    {
        FramePlan frame = plan();
        ASSERT_FALSE(frame.runs(name));
        const Pictures without = draw_planned(frame);
        EXPECT_GT(total(without.linear), 1);
        for (PlannedPass& pass : frame.passes)
            if (pass.name == name) pass.runs = true;
        const Pictures with = draw_planned(frame);
        EXPECT_EQ(with.linear.rgba, without.linear.rgba);
        EXPECT_EQ(with.display.rgb, without.display.rgb);
    }
};

TEST_F(Skips, LightsThatAreOff)
{
    scene.lights.push_back(point_light({0, 5, 1}, 100));
    scene.lights.front().on = false;
    expect_nothing_lost("lights");
}

TEST_F(Skips, LightsOutOfRange)
{
    add_box({-1, 9.5F, -1}, {1, 10, 1}, {.albedo = {0.5F, 0.5F, 0.5F}, .emission = {0, 0, 0}});
    const Pictures without = draw_planned(plan());
    scene.lights.push_back(point_light({0, -30, 0}, 1e6));
    scene.lights.front().range_m = 20;
    ASSERT_FALSE(plan().runs("lights"));
    EXPECT_EQ(draw_planned(plan()).linear.rgba, without.linear.rgba);
    scene.lights.front().range_m = 60;
    ASSERT_TRUE(plan().runs("lights"));
    EXPECT_NE(draw_planned(plan()).linear.rgba, without.linear.rgba) << "the test can fail";
}

TEST_F(Skips, SceneWithNothingSolid)
{
    expect_nothing_lost("scene");
}

TEST_F(Skips, FadeWithNothingSolid)
{
    expect_nothing_lost("fade");
}

TEST_F(Skips, FadeOfOpaquePoints)
{
    add_box({-1, 6, -1}, {1, 10, 1}, {.albedo = {0.5F, 0.5F, 0.5F}, .emission = {0, 0, 0}});
    scene.render.blending = scene::Blending::opaque;
    expect_nothing_lost("fade");
}

TEST_F(Skips, FlakesWhereNoneIsAlive)
{
    places.clear();
    ids.clear();
    stats.counts.alive = 0;
    for (const char* pass : {"flakes", "fade"}) expect_nothing_lost(pass);
}

TEST_F(Skips, SortOfOpaquePoints)
{
    scene.render.blending = scene::Blending::opaque;
    ASSERT_FALSE(plan().runs("sort"));
    EXPECT_EQ(draw_planned(plan()).linear.rgba, draw_planned(plan(), true).linear.rgba);
}

// Half floats round every sum, so that the order shows in the last of their 11 bits, a few times over.
TEST_F(Skips, SortOfAdditiveFlakes)
{
    scene.render.blending = scene::Blending::additive;
    ASSERT_FALSE(plan().runs("sort"));
    const image::Image one = draw_planned(plan()).linear, other = draw_planned(plan(), true).linear;
    EXPECT_NE(one.rgba, draw_planned(
                            [&]
                            {
                                FramePlan none = plan();
                                for (PlannedPass& pass : none.passes)
                                    if (pass.name == "flakes") pass.runs = false;
                                return none;
                            }())
                            .linear.rgba);
    for (std::size_t i = 0; i < one.rgba.size(); ++i)
        ASSERT_NEAR(one.rgba[i], other.rgba[i], 10 * one.rgba[i] / 2048) << i;
}

TEST_F(Skips, ExposureThatTheSceneSets)
{
    scene.render.exposure = 1.3;
    ASSERT_FALSE(plan().runs("exposure"));
    const Pictures set = draw_planned(plan());
    for (std::size_t i = 0; i < set.display.rgb.size(); ++i)
    {
        const std::size_t pixel = i / 3, x = pixel % 96, y = pixel / 96;
        const double light = set.linear.pixel(static_cast<int>(x), static_cast<int>(y))[i % 3];
        ASSERT_NEAR(set.display.rgb[i], 255 * srgb_encoded(std::min(1.3 * light, 1.0)), 0.51);
    }
}

TEST_F(Skips, BloomOfWeightNothing)
{
    scene.sky.zenith = scene.sky.horizon = {3, 3, 3};
    expect_nothing_lost("bloom");
}

TEST_F(Skips, BloomWhereNothingCanBeBright)
{
    scene.bloom.weight = 0.5;
    scene.bloom.threshold = 0.8;
    scene.bloom.knee = 0.4;  // sets in at 0.48
    add_box({-1, 9.5F, -1}, {1, 10, 1}, {.albedo = {1, 1, 1}, .emission = {0, 0, 0}});
    expect_nothing_lost("bloom");
    stats.brightest_emission = 0.3;  // 0.3 of ambient light on top
    EXPECT_TRUE(plan().runs("bloom"));
    stats.brightest_emission = 0;
    scene.render.blending = scene::Blending::additive;
    EXPECT_TRUE(plan().runs("bloom")) << "sums have no bound";
    scene.render.blending = scene::Blending::over;
    scene.lights.push_back(point_light({0, 5, 1}, 100));
    EXPECT_TRUE(plan().runs("bloom")) << "a lamp may shine on anything";
}

// The plan cannot know, the GPU finds out in the same frame: no bit of the picture changes.
TEST_F(Skips, BloomChainWhereTheGpuFindsNothingBright)
{
    const Pictures without = draw_planned(plan());
    scene.bloom.weight = 0.5;
    stats.brightest_emission = std::numeric_limits<double>::infinity();
    add_box({50, 50, 50}, {51, 51, 51}, {});  // out of sight
    ASSERT_TRUE(plan().runs("bloom"));
    const Pictures with = draw_planned(plan());
    EXPECT_FALSE(with.found_bright);
    EXPECT_EQ(with.display.rgb, without.display.rgb);
    scene.sky.horizon = {2, 2, 2};
    EXPECT_TRUE(draw_planned(plan()).found_bright);
}

TEST_F(Skips, FogWhereTheAirIsClearEnough)
{
    scene.air.source = scene::AirSource::visibility;
    scene.air.visibility_m = 1.3e5;  // 0.46 % are lost up to the far plane
    add_box({-1, 9.5F, -1}, {1, 10, 1}, {.albedo = {0.5F, 0.5F, 0.5F}, .emission = {0, 0, 0}});
    FramePlan frame = plan();
    ASSERT_FALSE(frame.runs("fog"));
    const Pictures without = draw_planned(frame);
    for (PlannedPass& pass : frame.passes)
        if (pass.name == "fog") pass.runs = true;
    const Pictures with = draw_planned(frame);
    double most = 0;  // over the light of the thing or of the fog, whichever is more
    for (std::size_t i = 0; i < with.linear.rgba.size(); ++i)
        if (i % 4 != 3)
            most = std::max(most, std::abs(double{with.linear.rgba[i]} - without.linear.rgba[i]) /
                                      std::max(double{without.linear.rgba[i]}, 0.3));
    EXPECT_GT(most, 1e-3) << "the test can fail";
    EXPECT_LT(most, 0.005 + 1.0 / 1024) << "as much as is stated, and half floats";
}

TEST_F(Skips, AirlightWithoutALampThatShines)
{
    scene.air.source = scene::AirSource::visibility;
    scene.air.visibility_m = 20;
    scene.lights.push_back(point_light({0, 5, 1}, 100));
    scene.lights.front().on = false;
    expect_nothing_lost("airlight");
}

TEST_F(Skips, PictureWhereNothingMoves)
{
    test_context();
    places.clear();
    ids.clear();
    stats.counts.alive = 0;
    stats.camera_moved = false;
    add_box({-1, 9.5F, -1}, {1, 10, 1}, {.albedo = {0.5F, 0.5F, 0.5F}, .emission = {0, 0, 0}});
    scene.display.tone = ToneCurve::reinhard;
    const FlakeBuffers buffers(1);
    Renderer renderer(scene, geometry, world, buffers, view.width_px, view.height_px);
    const FramePlan first = plan();
    renderer.draw(first, view, {}, 0);
    const image::Image8 before = renderer.read_display();
    stats.shown = first.shown;
    ASSERT_TRUE(plan().still);
    renderer.draw(plan(), view, {}, 1);
    EXPECT_EQ(renderer.read_display().rgb, before.rgb);
    renderer.develop_low_range();
    EXPECT_NE(renderer.read_display().rgb, before.rgb) << "the test can fail";
    renderer.draw(plan(), view, {}, 2);
    EXPECT_EQ(renderer.read_display().rgb, before.rgb);
    renderer.draw(first, view, {}, 2);
    EXPECT_EQ(renderer.read_display().rgb, before.rgb) << "drawn anew";
}

/// A wall whose shadow falls on another, and flakes that the light has to get past.
struct ShadowSkips : Skips
{
    ShadowSkips()
    {
        add_box({-0.2F, 9.2F, -0.1F}, {0, 9.3F, 0.1F}, {.albedo = {0.5F, 0.5F, 0.5F}, .emission = {0, 0, 0}});
        add_box({-1, 9.8F, -1}, {1, 10, 1}, {.albedo = {0.5F, 0.5F, 0.5F}, .emission = {0, 0, 0}});
        scene.domain.max_m = {100, 100, 100};
        scene::Light sun;
        sun.kind = scene::LightKind::directional;
        sun.direction = {0.6, 0.8, 0};
        sun.intensity = {2, 2, 2};
        sun.shadow = true;
        scene.lights.push_back(sun);
    }

    /// Draws twice with one renderer, the second time what the plan then leaves out; the same in one go.
    void expect_the_same_picture_again(const char* pass)
    {
        test_context();
        const FlakeBuffers buffers(places.size());
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            buffers.flakes().x[i] = places[i].x;
            buffers.flakes().y[i] = places[i].y;
            buffers.flakes().z[i] = places[i].z;
            buffers.flakes().id[i] = ids[i];
            buffers.draw_list().pairs[i] = i << 32 | i;
        }
        DrawList list;
        list.count = list.slots = places.size();
        Renderer renderer(scene, geometry, world, buffers, view.width_px, view.height_px);
        const FramePlan first = plan();
        ASSERT_TRUE(first.runs(pass));
        renderer.draw(first, view, list, 0);
        const image::Image before = renderer.read_linear();
        stats.shadows = first.shadows;
        stats.snow_shaded = first.lit.snow;
        stats.flakes_moved = false;
        const FramePlan second = plan();
        ASSERT_FALSE(second.runs(pass));
        renderer.draw(second, view, list, 0);
        EXPECT_EQ(renderer.read_linear().rgba, before.rgba);
        FramePlan lost = second;
        lost.lit = {first.lit.lights};
        renderer.draw(lost, view, list, 0);
        EXPECT_NE(renderer.read_linear().rgba, before.rgba) << "the test can fail";
    }
};

TEST_F(ShadowSkips, MapsOfLightsAndThingsAtRest)
{
    expect_the_same_picture_again("shadows");
}

TEST_F(ShadowSkips, SlicesOfFlakesAtRest)
{
    scene.shadows.snow_slices = 4;
    expect_the_same_picture_again("snow shade");
}

TEST_F(Skips, ExposureOfTheOtherEyeOfAPair)
{
    test_context();
    scene.render.auto_exposure = true;
    scene.render.adaptation_s = 2;
    const FlakeBuffers buffers(1);
    Renderer renderer(scene, geometry, world, buffers, view.width_px, view.height_px);
    const auto eye = [&](double side, bool exposed, double time_s)
    {
        View seen = view;
        seen.forward = side > 0 ? Vec3f{0, 0, 1} : Vec3f{0, 1, 0};  // the eyes see different light
        seen.up = side > 0 ? Vec3f{0, -1, 0} : Vec3f{0, 0, 1};
        stats.exposed = exposed;
        renderer.draw(plan_frame(scene, seen, stats, time_s), seen, {}, time_s);
        return renderer.exposure();
    };
    const double left = eye(-1, false, 0);
    EXPECT_EQ(eye(1, true, 0), left);
    const double later = eye(-1, false, 1);
    EXPECT_NEAR(later, left, 1e-4 * left) << "nothing changed for the eye that is metered";
    const double turned = eye(1, false, 2);
    EXPECT_NE(turned, left);
    const double settled = eye(1, false, 1000);
    EXPECT_NEAR(std::log(turned / later) / std::log(settled / later), 1 - std::exp(-0.5), 0.01)
        << "the way that passes in 1 s of 2 s";
}

}  // namespace
}  // namespace spindrift::gl
