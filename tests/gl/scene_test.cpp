// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "tests/gl/stage.h"

namespace spindrift::gl
{
namespace
{

constexpr double kPi = 3.14159265358979;

scene::Material grey(float albedo)
{
    return {.albedo = {albedo, albedo, albedo}, .emission = {0, 0, 0}};
}

struct SceneDrawing : testing::Test, Stage
{
    SceneDrawing() { view.tan_half_fov_y = 0.5F; }
};

TEST_F(SceneDrawing, SkyRunsFromHorizonToZenith)
{
    scene.sky.horizon = {1, 0, 0};
    scene.sky.zenith = {0, 0, 1};
    view.tan_half_fov_y = 1;
    const image::Image image = draw();
    for (const int row : {2, 20, 31, 40, 60})
    {
        const double up = (31.5 - row) / 32.0;
        const double across = 0.5 / 32.0;
        const double d_z = up / std::sqrt(1 + up * up + across * across);
        const double share = std::sqrt(std::max(d_z, 0.0));
        EXPECT_NEAR(image.pixel(48, row)[2], share, 5e-3) << row;
        EXPECT_NEAR(image.pixel(48, row)[0], 1 - share, 5e-3) << row;
        EXPECT_EQ(image.pixel(48, row)[3], 1);
    }
}

TEST_F(SceneDrawing, BoxIsLitByAmbientAndLamp)
{
    scene.sky.ambient = {0.4F, 0.4F, 0.4F};
    add_box({-1, 5, -1}, {1, 6, 1}, grey(0.5F));
    // A wall that faces the camera: n_z = 0.
    EXPECT_NEAR(draw().pixel(48, 32)[0], 0.5 * 0.4 * 0.75, 2e-3);
    scene.lights = {point_light({0, 3, 0}, 4 * kPi)};
    EXPECT_NEAR(draw().pixel(48, 32)[0], 0.5 * (0.4 * 0.75 + 1.0), 5e-3);
    geometry.meshes[0].materials[0].emission = {2, 2, 2};
    EXPECT_NEAR(draw().pixel(48, 32)[0], 2 + 0.5 * (0.4 * 0.75 + 1.0), 5e-3);
}

TEST_F(SceneDrawing, ManyLampsShineLikeTheirSum)
{
    // Few lamps reach the fragments as varyings, up to eight as uniforms, more as a buffer.
    view.eye = {3, 0, 0};
    scene.sky.ambient = {0, 0, 0};
    add_box({2, 5, -1}, {4, 6, 1}, grey(1.0F));
    for (const int lamps : {1, 4, 5, 8, 9, 20})
    {
        scene.lights.assign(static_cast<std::size_t>(lamps), point_light({3, 3, 0}, 4 * kPi / lamps));
        EXPECT_NEAR(draw().pixel(48, 32)[0], 1.0, 5e-3) << lamps << " lamps";
    }
}

TEST_F(SceneDrawing, GroundReachesToTheFarPlane)
{
    scene.ground.kind = scene::GroundKind::plane;
    scene.ground.height_m = -2;
    scene.ground.albedo = {1, 1, 1};
    scene.sky.ambient = {0.3F, 0.3F, 0.3F};
    scene.sky.horizon = scene.sky.zenith = {0, 9, 0};
    view.far_m = 100;
    scene.camera.far_m = 100;
    geometry = scene::read_geometry(scene);
    const image::Image image = draw();
    EXPECT_NEAR(image.pixel(48, 60)[0], 0.3, 1e-3);
    // Depth 100 m at 2 m below the eye: 64 * 2 / 100 = 1.28 px under the horizon.
    EXPECT_NEAR(image.pixel(48, 34)[0], 0.3, 1e-3);
    EXPECT_NEAR(image.pixel(2, 34)[0], 0.3, 1e-3);
    EXPECT_NEAR(image.pixel(48, 32)[1], 9, 1e-2);
    EXPECT_NEAR(image.pixel(48, 30)[1], 9, 1e-2);
}

TEST_F(SceneDrawing, FlakeBehindTheBoxIsHidden)
{
    scene.sky.ambient = {1, 1, 1};
    add_box({-1, 5, -1}, {1, 6, 1}, grey(0));
    scene.render.flake_scale = 10;
    world.snow.weight = 100;
    add_flake({0, 7, 0}, id_of_diameter(0.01));
    EXPECT_EQ(total(draw()), 0);
    places[0].y = 4;
    EXPECT_GT(total(draw()), 0.1);
}

TEST_F(SceneDrawing, DroppingHiddenFlakesEarlyChangesNoPixel)
{
    scene.sky.ambient = {1, 1, 1};
    add_box({-1, 5, -1}, {0.3F, 6, 0.7F}, grey(0.1F));
    add_box({0.5F, 4, -3}, {0.55F, 4.1F, 3}, grey(0.1F));  // one pixel wide
    std::uint32_t random = 7;
    const auto unit = [&]
    {
        random = random * 1664525U + 1013904223U;
        return static_cast<float>(random >> 8) / 16777216.0F;
    };
    scene.render.flake_scale = 4;
    world.snow.weight = 16;
    for (int i = 0; i < 3000; ++i)
    {
        const float depth = 12 - 4.0F * static_cast<float>(i) / 1000.0F - 0.1F * unit();
        add_flake({depth * (1.5F * unit() - 0.75F), depth, depth * (unit() - 0.5F)},
                  static_cast<std::uint32_t>(i));
    }
    // Far, sorted flakes go through the shader that drops; unsorted ones through the one that leaves all to
    // the depth test.
    scene.render.blending = scene::Blending::additive;
    const image::Image dropped = draw();
    sorted = false;
    const image::Image kept = draw();
    EXPECT_GT(total(kept), 100);
    for (std::size_t i = 0; i < kept.rgba.size(); ++i) ASSERT_NEAR(dropped.rgba[i], kept.rgba[i], 0.01) << i;
}

TEST_F(SceneDrawing, FlakeFadesWhereItCutsIntoTheScene)
{
    scene.sky.ambient = {1, 1, 1};
    scene.render.sprite = scene::Sprite::point;
    add_box({-10, 5, -10}, {10, 6, 10}, grey(0));
    const std::uint32_t id = id_of_diameter(0.01);
    // Small: looked up at the centre; large: pixel by pixel. The fade is 5 cm deep, or the flake's radius.
    for (const double scale : {0.1, 8.0})
    {
        scene.render.flake_scale = scale;
        world.snow.weight = static_cast<float>(scale * scale);
        const double depth = std::max(0.05, 0.005 * scale);
        places = {{0, static_cast<float>(5 - 2 * depth), 0}};
        ids = {id};
        const double whole = draw().pixel(47, 31)[0];
        for (const double share : {0.75, 0.5, 0.25})
        {
            places[0].y = static_cast<float>(5 - share * depth);
            EXPECT_NEAR(draw().pixel(47, 31)[0] / whole, share, 0.02) << scale;
        }
    }
}

TEST_F(SceneDrawing, VehiclesCarryTheirMeshes)
{
    add_box({-1, 0, -1}, {1, 1, 1}, grey(0.5F));
    geometry.meshes[0].vehicle = "plow";
    scene::VehicleSettings plow;
    plow.name = "plow";
    plow.path.keys.push_back({0, {0, 20, 0}});
    scene.vehicles.push_back(plow);
    scene.sky.ambient = {1, 1, 1};
    const double far_sum = total(draw());
    scene.vehicles[0].path.keys[0].position_m.y = 10;
    const double near_sum = total(draw());
    EXPECT_GT(far_sum, 1);
    EXPECT_NEAR(near_sum / far_sum, 4, 0.5);
}

TEST_F(SceneDrawing, DisplayIsTheExactCurveOfTheLinearPicture)
{
    scene.sky.horizon = {0, 0.002F, 0.2F};
    scene.sky.zenith = {1.5F, 0.5F, 0.01F};
    scene.render.exposure = 1.25;
    view.tan_half_fov_y = 2;
    test_context();
    const std::string errors_before = Context::debug_errors();
    const FlakeBuffers buffers(1);
    Renderer renderer(scene, geometry, world, buffers, 96, 64);
    renderer.draw(plan_frame(scene, view, {}, 0), view, {}, 0);
    const image::Image linear = renderer.read_linear();
    const image::Image8 display = renderer.read_display();
    for (std::size_t i = 0; i < 96 * 64 * 3; ++i)
    {
        const double c = std::clamp(1.25 * static_cast<double>(linear.rgba[i / 3 * 4 + i % 3]), 0.0, 1.0);
        const double srgb = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
        ASSERT_NEAR(display.rgb[i], srgb * 255, 1.0) << i;
    }
    EXPECT_EQ(Context::debug_errors(), errors_before);
}

TEST_F(SceneDrawing, ResizesAndTellsTimes)
{
    test_context();
    const std::string errors_before = Context::debug_errors();
    const FlakeBuffers buffers(1);
    scene.sky.horizon = scene.sky.zenith = {1, 1, 1};
    Renderer renderer(scene, geometry, world, buffers, 96, 64);
    EXPECT_TRUE(renderer.times().empty());
    for (const int width : {96, 33, 160})
    {
        view.width_px = width;
        renderer.resize(width, 64);
        for (int frame = 0; frame < 3; ++frame) renderer.draw(plan_frame(scene, view, {}, 0), view, {}, 0);
        const image::Image image = renderer.read_linear();
        EXPECT_EQ(image.width, width);
        EXPECT_NEAR(total(image), width * 64, 1);
    }
    renderer.wait_for_flakes();
    std::vector<std::string> names;
    for (const PassTime& time : renderer.times())
    {
        names.push_back(time.name);
        EXPECT_GE(time.ms, 0);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"sky", "tone"}));
    EXPECT_THROW(renderer.resize(0, 64), std::exception);
    EXPECT_EQ(Context::debug_errors(), errors_before);
}

TEST_F(SceneDrawing, ManyFlakesRoundAStreetLamp)
{
    view.width_px = 640;
    view.height_px = 360;
    view.eye = {0, 0, 1.7F};
    scene.ground.kind = scene::GroundKind::plane;
    geometry = scene::read_geometry(scene);
    scene.sky = {{0.02F, 0.02F, 0.04F}, {0.06F, 0.05F, 0.06F}, {0.03F, 0.03F, 0.04F}};
    scene.lights = {point_light({1, 9, 5}, 60)};
    scene.lights[0].intensity = {80, 50, 18};
    scene.render.flake_scale = 2;
    world.snow.weight = 4;
    add_box({-6, 10, 0}, {-2, 14, 6}, grey(0.4F));
    add_box({0.95F, 8.95F, 0}, {1.05F, 9.05F, 4.9F}, grey(0.2F));
    std::uint32_t random = 1;
    const auto unit = [&]
    {
        random = random * 1664525U + 1013904223U;
        return static_cast<float>(random >> 8) / 16777216.0F;
    };
    std::vector<Vec3f> cloud;
    for (int i = 0; i < 20000; ++i) cloud.push_back({-12 + 24 * unit(), 0.4F + 20 * unit(), 8 * unit()});
    std::sort(cloud.begin(), cloud.end(),
              [&](const Vec3f& a, const Vec3f& b)
              { return dot(a - view.eye, a - view.eye) > dot(b - view.eye, b - view.eye); });
    for (std::uint32_t i = 0; i < cloud.size(); ++i) add_flake(cloud[i], i);
    const image::Image image = draw_and_keep("street", 0.5);
    EXPECT_TRUE(all_finite(image));
    EXPECT_GT(total(image), 1000);
}

}  // namespace
}  // namespace spindrift::gl
