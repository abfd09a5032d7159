// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "tests/gl/stage.h"

namespace spindrift::gl
{
namespace
{

constexpr double kPi = 3.14159265358979;

double phase(double g, double mu)
{
    return (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * mu, 1.5));
}

/// One plain disc, 2.5 px in radius, in the middle of the picture: its pixel is the flake's radiance.
struct FlakeLight : testing::Test, Stage
{
    double depth_m;

    FlakeLight()
    {
        scene.render.sprite = scene::Sprite::point;
        const std::uint32_t id = id_of_diameter(0.006);
        depth_m = radius_px(id, 1.0) / 2.5;
        add_flake({0, static_cast<float>(depth_m), 0}, id);
    }
    double radiance(double time_s = 0) const { return draw(time_s).pixel(48, 32)[0]; }
};

TEST_F(FlakeLight, NoLightsLeaveAmbientOnce)
{
    scene.sky.ambient = {0.5F, 0.5F, 0.5F};
    EXPECT_NEAR(radiance(), 0.5, 1e-3);
    for (int i = 0; i < 3; ++i) scene.lights.push_back(point_light({0, -1e6, 0}, 1e-6));
    EXPECT_NEAR(radiance(), 0.5, 1e-3) << "lights do not bring ambient light again";
}

TEST_F(FlakeLight, BehindTheFlakeIsTheForwardPeak)
{
    const double d = 2;
    for (const double g : {-0.5, 0.0, 0.5, 0.77, 0.95})
    {
        scene.lights = {point_light({0, depth_m + d, 0}, 4)};
        scene.lights[0].g = g;
        const double behind = radiance();
        scene.lights[0].position_m = {0, depth_m - d, 0};
        const double in_front = radiance();
        scene.lights[0].position_m = {d, depth_m, 0};
        const double beside = radiance();
        EXPECT_NEAR(behind, phase(g, 1) * 4 / (d * d), 1e-2 * phase(g, 1)) << g;
        EXPECT_NEAR(in_front, phase(g, -1) * 4 / (d * d), 1e-2 * phase(g, -1) + 1e-4) << g;
        EXPECT_NEAR(beside, phase(g, 0) * 4 / (d * d), 1e-2 * phase(g, 0) + 1e-4) << g;
        if (g > 0)
        {
            EXPECT_GT(behind, in_front) << "the physical sign";
        }
    }
}

TEST_F(FlakeLight, DirectionalLightHasNoDistance)
{
    scene::Light sun;
    sun.kind = scene::LightKind::directional;
    sun.direction = {0, -1, 0};  // travels towards the camera
    sun.intensity = {3, 3, 3};
    sun.g = 0.6;
    scene.lights = {sun};
    EXPECT_NEAR(radiance(), 3 * phase(0.6, 1), 1e-2);
    scene.lights[0].direction = {0, 1, 0};
    EXPECT_NEAR(radiance(), 3 * phase(0.6, -1), 1e-3);
}

TEST_F(FlakeLight, SpotConeFallsSmoothlyToItsRim)
{
    scene::Light spot = point_light({0, depth_m, 3}, 9 * 4 * kPi);
    spot.kind = scene::LightKind::spot;
    spot.g = 0;
    spot.inner_cone_deg = 10;
    spot.outer_cone_deg = 30;
    const auto tilted = [&](double degrees)
    {
        spot.direction = {std::sin(degrees * kPi / 180), 0, -std::cos(degrees * kPi / 180)};
        scene.lights = {spot};
        return radiance();
    };
    EXPECT_NEAR(tilted(0), 1, 1e-2);
    EXPECT_NEAR(tilted(9), 1, 1e-2);
    const double inner = std::cos(10 * kPi / 180);
    const double outer = std::cos(30 * kPi / 180);
    const double share = (std::cos(20 * kPi / 180) - outer) / (inner - outer);
    EXPECT_NEAR(tilted(20), share * share, 1e-2);
    EXPECT_EQ(tilted(31), 0);
}

TEST_F(FlakeLight, RangeWindowEndsTheLight)
{
    scene.lights = {point_light({0, depth_m, 2}, 4 * 4 * kPi)};
    scene.lights[0].g = 0;
    scene.lights[0].range_m = 4;
    EXPECT_NEAR(radiance(), 1 - std::pow(0.5, 4), 1e-2);
    scene.lights[0].range_m = 1.9;
    EXPECT_EQ(radiance(), 0);
}

TEST_F(FlakeLight, FlashesAtTheDisplayTime)
{
    scene.lights = {point_light({0, depth_m, 1}, 4 * kPi)};
    scene.lights[0].g = 0;
    scene.lights[0].flashing = true;
    scene.lights[0].flash_rate_hz = 2;
    scene.lights[0].flash_duty = 0.5;
    EXPECT_NEAR(radiance(0.1), 1, 1e-2);
    EXPECT_EQ(radiance(0.3), 0);
    EXPECT_NEAR(radiance(0.6), 1, 1e-2);
    scene.lights[0].flash_phase = 0.5;
    EXPECT_EQ(radiance(0.1), 0);
    scene.lights[0].exists = false;
    EXPECT_EQ(radiance(0.3), 0);
}

TEST_F(FlakeLight, SixtyFourLightsAddUp)
{
    for (int i = 0; i < 64; ++i)
    {
        const double angle = 2 * kPi * i / 64;
        scene.lights.push_back(point_light({std::cos(angle), depth_m, std::sin(angle)}, 4 * kPi / 64));
        scene.lights.back().g = 0;
    }
    EXPECT_NEAR(radiance(), 1, 1e-2);
}

TEST_F(FlakeLight, LightsOfModelsAndVehiclesShineToo)
{
    geometry.model_lights = {point_light({0, depth_m, 1}, 4 * kPi)};
    geometry.model_lights[0].g = 0;
    EXPECT_NEAR(radiance(), 1, 1e-2);
    geometry.model_lights.clear();
    scene::VehicleSettings plow;
    plow.name = "plow";
    plow.path.keys.push_back({0, {0, depth_m, -2}});
    scene.vehicles.push_back(plow);
    scene.lights = {point_light({0, 0, 3}, 4 * kPi)};
    scene.lights[0].vehicle = "plow";
    scene.lights[0].g = 0;
    EXPECT_NEAR(radiance(), 1, 1e-2);
}

TEST_F(FlakeLight, ImposterShadesTowardsTheLightAndKeepsTheMean)
{
    scene.render.sprite = scene::Sprite::crystal;
    scene.render.blending = scene::Blending::additive;
    scene.lights = {point_light({50, depth_m, 0}, 2500 * 4 * kPi)};
    scene.lights[0].g = 0;
    const std::uint32_t id = ids[0];
    places[0].y = static_cast<float>(radius_px(id, 1.0) / 20);
    const image::Image shaded = draw_and_keep("imposter");
    scene.lights.clear();
    scene.sky.ambient = {1, 1, 1};
    const image::Image flat = draw();
    const auto half = [](const image::Image& image, int side)
    {
        double sum = 0;
        for (int dy = -20; dy <= 20; ++dy)
            for (int dx = 1; dx <= 20; ++dx) sum += image.pixel(48 + side * dx, 32 + dy)[0];
        return sum;
    };
    EXPECT_GT(half(shaded, 1) / half(flat, 1), 1.1);
    EXPECT_LT(half(shaded, -1) / half(flat, -1), 0.9);
    EXPECT_NEAR(total(shaded) / total(flat), 1, 0.05);
}

}  // namespace
}  // namespace spindrift::gl
