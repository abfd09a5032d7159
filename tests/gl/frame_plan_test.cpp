// SPDX-License-Identifier: MIT
#include "gl/frame_plan.h"

#include <gtest/gtest.h>

#include <limits>

#include "gl/active_lights.h"

namespace spindrift::gl
{
namespace
{

struct PlanTest : testing::Test
{
    scene::Scene scene;
    View view;
    FrameStats stats;

    PlanTest()
    {
        stats.counts.alive = 1000;
        scene::Light lamp;
        lamp.position_m = {0, 10, 0};
        scene.lights.push_back(lamp);
    }
    FramePlan plan(double time_s = 0) const { return plan_frame(scene, view, stats, time_s); }
    std::string reason(const std::string& name, double time_s = 0) const
    {
        for (const PlannedPass& pass : plan(time_s).passes)
            if (pass.name == name) return pass.reason;
        return "";
    }
};

TEST_F(PlanTest, RunsEverythingWhereEverythingIsNeeded)
{
    const FramePlan p = plan();
    for (const char* name : {"cull", "sort", "lights", "scene", "sky", "fade", "flakes", "tone"})
        EXPECT_TRUE(p.runs(name)) << name;
    EXPECT_FALSE(p.runs("bloom"));
}

TEST_F(PlanTest, NoFlakesNothingToCullSortFadeOrDraw)
{
    stats.counts.alive = 0;
    for (const char* name : {"cull", "sort", "fade", "flakes"})
    {
        EXPECT_FALSE(plan().runs(name)) << name;
        EXPECT_NE(reason(name).find("no flakes"), std::string::npos);
    }
    EXPECT_TRUE(plan().runs("scene"));
    EXPECT_TRUE(plan().runs("lights")) << "surfaces are lit too";
}

TEST_F(PlanTest, AdditiveAndOpaqueNeedNoSort)
{
    for (const scene::Blending unsorted : {scene::Blending::weighted, scene::Blending::stochastic})
    {
        scene.render.blending = unsorted;
        EXPECT_FALSE(plan().runs("sort"));
        EXPECT_TRUE(plan().runs("flakes"));
    }
    scene.render.blending = scene::Blending::additive;
    EXPECT_FALSE(plan().runs("sort"));
    EXPECT_TRUE(plan().runs("cull"));
    EXPECT_TRUE(plan().runs("fade"));
    scene.render.blending = scene::Blending::opaque;
    EXPECT_FALSE(plan().runs("sort"));
    EXPECT_FALSE(plan().runs("fade"));
    EXPECT_TRUE(plan().runs("flakes"));
}

TEST_F(PlanTest, SoftwareGlDrawsBlendedFlakesInTiles)
{
    const auto in_tiles = [&](GlKind gl)
    {
        const FramePlan p = plan_frame(scene, view, stats, 0, {}, gl);
        EXPECT_NE(p.runs("tiles"), p.runs("flakes"));
        EXPECT_FALSE(p.runs("tiles") && p.runs("fade"));
        return p.runs("tiles");
    };
    EXPECT_TRUE(in_tiles(GlKind::software));
    EXPECT_FALSE(in_tiles(GlKind::out_of_reach)) << "the processor cannot read the flakes";
    EXPECT_FALSE(in_tiles(GlKind::hardware));
    EXPECT_FALSE(in_tiles(GlKind::unknown));
    scene.render.flake_path = scene::FlakePath::raster;
    EXPECT_FALSE(in_tiles(GlKind::software));
    scene.render.flake_path = scene::FlakePath::tiles;
    EXPECT_TRUE(in_tiles(GlKind::hardware));
    EXPECT_NE(reason("tiles").find("the scene asks"), std::string::npos) << reason("tiles");
    EXPECT_NE(reason("flakes").find("in tiles"), std::string::npos) << reason("flakes");
    scene.render.blending = scene::Blending::opaque;
    EXPECT_FALSE(in_tiles(GlKind::software)) << "opaque points need the depth buffer";
    EXPECT_NE(reason("tiles").find("depth buffer"), std::string::npos) << reason("tiles");
}

TEST_F(PlanTest, RestNeedsNoNewSort)
{
    stats.flakes_moved = false;
    EXPECT_TRUE(plan().runs("sort")) << "the camera still moves";
    stats.camera_moved = false;
    EXPECT_FALSE(plan().runs("sort"));
    EXPECT_FALSE(plan().runs("cull"));
    EXPECT_TRUE(plan().runs("flakes"));
}

TEST_F(PlanTest, DarkLightsLeaveTheScatteringLoopOut)
{
    scene.lights.front().on = false;
    EXPECT_FALSE(plan().runs("lights"));
    EXPECT_NE(reason("lights").find("off"), std::string::npos);
    scene.lights.clear();
    EXPECT_FALSE(plan().runs("lights"));
    const std::vector<scene::Light> lamp(1);
    EXPECT_TRUE(plan_frame(scene, view, stats, 0, lamp).runs("lights")) << "a model brings its own";
}

TEST_F(PlanTest, FlashingFollowsTheDisplayTime)
{
    scene::Light& lamp = scene.lights.front();
    lamp.flashing = true;
    lamp.flash_rate_hz = 2;
    lamp.flash_duty = 0.25;
    lamp.flash_phase = 0.5;
    // Ahead by half a period of 0.5 s: on in [0.25, 0.375) s.
    EXPECT_FALSE(plan(0.24).runs("lights"));
    EXPECT_TRUE(plan(0.26).runs("lights"));
    EXPECT_TRUE(plan(0.37).runs("lights"));
    EXPECT_FALSE(plan(0.38).runs("lights"));
    EXPECT_TRUE(plan(100.26).runs("lights"));
    EXPECT_NE(reason("lights", 0.1).find("flash"), std::string::npos);
}

TEST_F(PlanTest, LampsOutOfRangeAreLeftOut)
{
    scene::Light& lamp = scene.lights.front();
    lamp.range_m = 5;
    EXPECT_TRUE(plan().runs("lights"));
    lamp.position_m = {0, -20, 0};  // behind the camera
    EXPECT_FALSE(plan().runs("lights"));
    EXPECT_NE(reason("lights").find("out of range"), std::string::npos);
    lamp.position_m = {0, -4, 0};  // behind, but its range reaches in
    EXPECT_TRUE(plan().runs("lights"));
    lamp.position_m = {200, 10, 0};  // far to the side
    EXPECT_FALSE(plan().runs("lights"));
    lamp.range_m = 300;
    EXPECT_TRUE(plan().runs("lights"));
    lamp.kind = scene::LightKind::directional;
    lamp.range_m = 0.1;
    EXPECT_TRUE(plan().runs("lights")) << "directional lights have no range";
}

TEST_F(PlanTest, ClearAirNeedsNoFog)
{
    EXPECT_FALSE(plan().runs("fog"));
    EXPECT_NE(reason("fog").find("clear"), std::string::npos);
    EXPECT_FALSE(plan().runs("airlight"));
    scene.air.source = scene::AirSource::visibility;
    scene.air.visibility_m = 1e6;
    EXPECT_FALSE(plan().runs("fog"));
    EXPECT_NE(reason("fog").find("above 99.5 %"), std::string::npos) << reason("fog");
    scene.air.visibility_m = 500;
    EXPECT_TRUE(plan().runs("fog"));
    EXPECT_NE(reason("fog").find("500 m (5 %)"), std::string::npos) << reason("fog");
}

TEST_F(PlanTest, ManyPointLampsGlowFromGrids)
{
    scene.air.source = scene::AirSource::visibility;
    scene.air.visibility_m = 100;
    scene.lights.clear();
    EXPECT_NE(reason("glow grids").find("no lamp glows"), std::string::npos);
    scene::Light lamp;
    lamp.kind = scene::LightKind::point;
    lamp.position_m = {view.eye.x, view.eye.y + 12.0, view.eye.z};
    lamp.intensity = {5, 5, 5};
    lamp.range_m = 20;
    scene.lights.assign(8, lamp);
    EXPECT_TRUE(plan().runs("airlight"));
    EXPECT_FALSE(plan().runs("glow grids")) << "few lamps are integrated on each way";
    EXPECT_FALSE(plan().lit.glow_grids);
    scene.lights.assign(11, lamp);
    scene.lights[3].kind = scene::LightKind::spot;
    scene.lights[5].range_m = std::numeric_limits<double>::infinity();
    scene.lights[7].position_m.y += 400;
    scene.lights[7].range_m = 5;
    const FramePlan planned = plan();
    EXPECT_TRUE(planned.lit.glow_grids);
    EXPECT_NE(reason("glow grids").find(" of "), std::string::npos) << reason("glow grids");
    EXPECT_NE(reason("airlight").find("but those that have a grid"), std::string::npos);
    std::int32_t next = 0;
    for (const std::int32_t grid : planned.glow_grids)
    {
        EXPECT_TRUE(grid == -1 || grid == next);
        next += grid >= 0;
    }
    EXPECT_EQ(next, 8) << "not the spot, the endless one, nor the one that nearly no way sees";
    for (scene::Light& light : scene.lights) light.kind = scene::LightKind::spot;
    EXPECT_FALSE(plan().runs("glow grids"));
}

TEST_F(PlanTest, OnlyLampsThatShineGlowInTheFog)
{
    scene.air.source = scene::AirSource::visibility;
    scene.air.visibility_m = 100;
    EXPECT_TRUE(plan().runs("airlight"));
    scene.lights.front().on = false;
    EXPECT_FALSE(plan().runs("airlight"));
    scene.lights.front().on = true;
    scene.lights.front().kind = scene::LightKind::directional;
    EXPECT_FALSE(plan().runs("airlight")) << "the sun is in the fog's own light";
    scene.lights.front().kind = scene::LightKind::point;
    scene.air.airlight = false;
    EXPECT_FALSE(plan().runs("airlight"));
    EXPECT_TRUE(plan().runs("fog"));
    scene.air.airlight = true;
    scene.air.law = scene::FogLaw::legacy;
    EXPECT_FALSE(plan().runs("airlight"));
}

TEST_F(PlanTest, ShadowsAreDrawnAnewOnlyWhenLampsOrVehiclesMove)
{
    EXPECT_FALSE(plan().runs("shadows"));
    EXPECT_NE(reason("shadows").find("no light that shines casts"), std::string::npos) << reason("shadows");
    scene::Light& lamp = scene.lights.front();
    lamp.kind = scene::LightKind::spot;
    lamp.shadow = true;
    const FramePlan first = plan();
    EXPECT_TRUE(first.runs("shadows"));
    EXPECT_EQ(first.lit.shadows, 1U);
    stats.shadows = first.shadows;
    EXPECT_FALSE(plan().runs("shadows"));
    EXPECT_TRUE(plan().lit.maps) << "they are looked up all the same";
    EXPECT_NE(reason("shadows").find("at rest"), std::string::npos) << reason("shadows");
    lamp.position_m.x += 1;
    EXPECT_TRUE(plan().runs("shadows"));
    lamp.position_m.x -= 1;
    scene::VehicleSettings car;
    car.name = "car";
    car.path.keys = {{0, {0, 0, 0}}, {10, {100, 0, 0}}};
    scene.vehicles.push_back(car);
    EXPECT_FALSE(plan(5).runs("shadows")) << "nothing stands on it";
    scene.models.emplace_back().vehicle = "car";
    stats.shadows = plan(5).shadows;
    EXPECT_FALSE(plan(5).runs("shadows"));
    EXPECT_TRUE(plan(6).runs("shadows"));
    lamp.on = false;
    EXPECT_FALSE(plan(6).runs("shadows"));
    EXPECT_EQ(plan(6).lit.shadows, 0U);
}

TEST_F(PlanTest, SnowDimsLightWhereTheSceneAsksAndFlakesMove)
{
    scene::Light& lamp = scene.lights.front();
    lamp.kind = scene::LightKind::directional;
    lamp.shadow = true;
    EXPECT_FALSE(plan().runs("snow shade"));
    EXPECT_NE(reason("snow shade").find("no slices"), std::string::npos) << reason("snow shade");
    scene.shadows.snow_slices = 8;
    EXPECT_TRUE(plan().runs("snow shade"));
    stats.shadows = plan().shadows;
    stats.snow_shaded = true;
    EXPECT_TRUE(plan().runs("snow shade")) << "flakes move";
    stats.flakes_moved = false;
    EXPECT_FALSE(plan().runs("snow shade"));
    EXPECT_TRUE(plan().lit.snow);
    scene.render.blending = scene::Blending::additive;
    EXPECT_FALSE(plan().lit.snow) << "what is added hides nothing";
    scene.render.blending = scene::Blending::over;
    stats.counts.alive = 0;
    EXPECT_FALSE(plan().runs("snow shade"));
}

TEST_F(PlanTest, LampsThatCastShadowsComeFirst)
{
    scene::Light sun;
    sun.kind = scene::LightKind::directional;
    sun.shadow = true;
    scene.lights.push_back(sun);
    const ActiveLights active = active_lights(scene, {}, view, 0);
    ASSERT_EQ(active.lamps.size(), 2U);
    EXPECT_TRUE(active.lamps[0].casts_shadow);
    EXPECT_FALSE(active.lamps[1].casts_shadow);
}

TEST_F(PlanTest, NothingThatMovesNeedsNoNewPicture)
{
    stats.counts.alive = 0;
    stats.camera_moved = false;
    EXPECT_FALSE(plan().still) << "no picture is there yet";
    stats.shown = plan().shown;
    EXPECT_TRUE(plan().still);
    for (const PlannedPass& pass : plan().passes) EXPECT_FALSE(pass.runs) << pass.name;
    EXPECT_NE(reason("tone").find("the picture of before holds"), std::string::npos);
    stats.camera_moved = true;
    EXPECT_FALSE(plan().still);
    stats.camera_moved = false;
    stats.counts.alive = 1;
    EXPECT_FALSE(plan().still) << "flakes turn";
    stats.counts.alive = 0;
    scene.render.auto_exposure = true;
    EXPECT_FALSE(plan().still) << "it adapts";
    scene.render.auto_exposure = false;
    scene.lights.front().flashing = true;
    scene.lights.front().flash_rate_hz = 1;
    EXPECT_TRUE(plan(0).still);
    EXPECT_FALSE(plan(0.6).still) << "the lamp is dark then";
}

TEST_F(PlanTest, EmptySceneHidesNothing)
{
    scene.ground.kind = scene::GroundKind::none;
    EXPECT_FALSE(plan().runs("scene"));
    EXPECT_FALSE(plan().runs("fade"));
}

TEST_F(PlanTest, EveryPassHasAReasonAndReadsLikeAnExplainedQuery)
{
    stats.counts.alive = 0;
    const FramePlan p = plan();
    const std::string text = to_text(p);
    for (const PlannedPass& pass : p.passes)
    {
        EXPECT_FALSE(pass.reason.empty()) << pass.name;
        EXPECT_NE(text.find(pass.name), std::string::npos);
        EXPECT_NE(text.find(pass.reason), std::string::npos);
    }
    EXPECT_NE(text.find("-> tone"), std::string::npos) << text;
    EXPECT_NE(text.find(" - sort"), std::string::npos) << text;
}

TEST_F(PlanTest, CostsGrowWithThePictureAndTheFlakes)
{
    scene.bloom.weight = 0.1;
    scene.render.auto_exposure = true;
    view.width_px = 640;
    view.height_px = 360;
    const auto cost = [&](const std::string& name)
    {
        for (const PlannedPass& pass : plan().passes)
            if (pass.name == name) return pass.cost;
        return PassCost{};
    };
    for (const char* name : {"scene", "sky", "fade", "exposure", "bloom", "tone"})
    {
        view.width_px = 640;
        const PassCost small = cost(name);
        view.width_px = 1280;
        EXPECT_NEAR(cost(name).megabytes / small.megabytes, 2, 1e-9) << name;
        EXPECT_NEAR(cost(name).million_elements / small.million_elements, 2, 1e-9) << name;
    }
    for (const char* name : {"cull", "sort", "flakes"})
    {
        stats.counts.alive = 1000;
        const PassCost few = cost(name);
        stats.counts.alive = 4000;
        EXPECT_NEAR(cost(name).megabytes / few.megabytes, 4, 1e-9) << name;
    }
    EXPECT_NEAR(cost("tone").megabytes, 1280 * 360 * 12e-6, 1e-9);
    EXPECT_NE(to_text(plan()).find("In all about "), std::string::npos);
    scene.bloom.weight = 0;
    EXPECT_EQ(cost("bloom").megabytes, 0) << "what is left out costs nothing";
}

TEST_F(PlanTest, BloomMethodsCostWhatTheyTouch)
{
    scene.bloom.weight = 0.1;
    view.width_px = 1280;
    view.height_px = 720;
    const auto million_texels = [&](scene::BloomMethod method)
    {
        scene.bloom.method = method;
        for (const PlannedPass& pass : plan().passes)
            if (pass.name == "bloom") return pass.cost.million_elements;
        return 0.0;
    };
    EXPECT_NEAR(million_texels(scene::BloomMethod::gaussian), 1280 * 720 * (1 + 2 * 257) * 1e-6, 1e-6);
    EXPECT_LT(million_texels(scene::BloomMethod::reduced), 3);
    EXPECT_LT(million_texels(scene::BloomMethod::reduced), million_texels(scene::BloomMethod::dual));
    EXPECT_LT(million_texels(scene::BloomMethod::dual), million_texels(scene::BloomMethod::pyramid));
}

TEST_F(PlanTest, TilesAreDevelopedWhereChannelsGoAlone)
{
    const auto in_tiles = [&]
    { return plan_frame(scene, view, stats, 0, {}, GlKind::software).tone_in_tiles; };
    EXPECT_TRUE(in_tiles());
    EXPECT_FALSE(plan().tone_in_tiles) << "no tiles, no tone in them";
    scene.display.tone = ToneCurve::legacy;
    EXPECT_TRUE(in_tiles());
    scene.display.tone = ToneCurve::neutral;
    EXPECT_FALSE(in_tiles());
    scene.display.tone = ToneCurve::linear;
    scene.bloom.weight = 0.1;
    EXPECT_FALSE(in_tiles());
    scene.bloom.weight = 0;
    scene.render.auto_exposure = true;
    EXPECT_FALSE(in_tiles());
}

TEST(ActiveLights, LieInTheLocalFrame)
{
    scene::Scene scene;
    scene.domain.min_m = {100, 200, 300};
    scene::Light lamp;
    lamp.position_m = {101, 203, 305};
    scene.lights.push_back(lamp);
    const ActiveLights active = active_lights(scene, {}, View{}, 0);
    ASSERT_EQ(active.lamps.size(), 1U);
    EXPECT_EQ(pack(active.lamps[0]).place, glm::vec4(1, 3, 5, 1));
}

}  // namespace
}  // namespace spindrift::gl
