// SPDX-License-Identifier: MIT
#include "reference/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/phase.h"
#include "tests/golden/small_scenes.h"

namespace spindrift::golden
{
namespace
{

constexpr std::uint32_t kLargeFlake = 33;  ///< about 10 mm by the seed of the small scenes

image::Image draw(SmallScene& small)
{
    return reference::render(small.scene, small.geometry, small.world, small.flakes.view(),
                             small.flakes.x.size(), small.view, small.time_s);
}

double sum_of(const image::Image& picture, int channel)
{
    double sum = 0;
    for (std::size_t i = static_cast<std::size_t>(channel); i < picture.rgba.size(); i += 4)
        sum += picture.rgba[i];
    return sum;
}

/// A flake straight ahead, opaque enough to be seen, on a black sky in white ambient light.
SmallScene one_flake(double distance_m, double enlargement)
{
    SmallScene small = empty_scene();
    small.scene.sky.zenith = small.scene.sky.horizon = {0, 0, 0};
    small.scene.sky.ambient = {1, 1, 1};
    enlarge(small, enlargement);
    small.flakes.add(small.view.eye + small.view.forward * static_cast<float>(distance_m), kLargeFlake);
    return small;
}

TEST(Reference, SkyRunsFromHorizonToZenith)
{
    SmallScene small = empty_scene();
    small.view.forward = {0, 0, 1};
    small.view.up = {0, -1, 0};
    const image::Image up = draw(small);
    // The four middle pixels look up but for half a pixel.
    EXPECT_NEAR(up.pixel(80, 60)[0], small.scene.sky.zenith.r, 1e-5);
    small.view.forward = {0, 1, 0};
    small.view.up = {0, 0, 1};
    const image::Image level = draw(small);
    EXPECT_EQ(level.pixel(80, 100)[2], small.scene.sky.horizon.b);
    const double slope = (60 - 0.5 - 20) / 120.0,
                 up_z = slope / std::sqrt(1 + slope * slope + std::pow(0.5 / 120.0, 2));
    const double share = std::sqrt(up_z);
    EXPECT_NEAR(level.pixel(80, 20)[0],
                small.scene.sky.horizon.r * (1 - share) + small.scene.sky.zenith.r * share, 1e-6);
}

TEST(Reference, GroundShowsItsAlbedoInAmbientLight)
{
    SmallScene small = empty_scene();
    add_ground(small);
    const image::Image picture = draw(small);
    EXPECT_NEAR(picture.pixel(80, 110)[1], small.scene.ground.albedo.g * small.scene.sky.ambient.g, 1e-6);
    EXPECT_NEAR(picture.pixel(80, 10)[3], 1, 0);
}

TEST(Reference, SurfaceUnderALampIsLambertian)
{
    SmallScene small = empty_scene();
    add_ground(small);
    small.scene.sky.ambient = {0, 0, 0};
    scene::Light lamp;
    lamp.kind = scene::LightKind::point;
    lamp.position_m = {20, 14, 3};
    lamp.intensity = {100, 50, 25};
    small.scene.lights = {lamp};
    const image::Image picture = draw(small);
    // Row 109 looks down by 49.5 px in 120: the ray meets the ground 5 * 120 / 49.5 m ahead.
    const double ahead = 5 * 120 / 49.5, side = 0.5 / 120 * ahead;
    const double dx = side, dy = 2 + ahead - 14, d2 = dx * dx + dy * dy + 9, cosine = 3 / std::sqrt(d2);
    EXPECT_NEAR(picture.pixel(80, 109)[0], small.scene.ground.albedo.r * 100 / d2 * cosine / std::numbers::pi,
                1e-5);
}

TEST(Reference, SmallFlakeKeepsItsCoverage)
{
    // The same flake at twice the distance covers a quarter, also far below a pixel; 1e-3 is what sampling at
    // pixel centres allows no more.
    std::vector<double> sums;
    for (const double distance : {2.0, 4.0, 8.0, 16.0})
    {
        double sum = 0;
        for (int shift = 0; shift < 64; ++shift)  // mean over positions in a pixel
        {
            SmallScene small = one_flake(distance, 4);
            small.flakes.x[0] += static_cast<float>(distance / 120 * (shift % 8) / 8);
            small.flakes.z[0] += static_cast<float>(distance / 120 * (shift / 8) / 8);
            sum += sum_of(draw(small), 1);
        }
        sums.push_back(sum);
    }
    for (std::size_t i = 1; i < sums.size(); ++i) EXPECT_NEAR(sums[i - 1] / sums[i], 4, 0.08) << i;
    EXPECT_GT(sums.back(), 0);
}

TEST(Reference, LampBehindTheFlakeGivesTheForwardPeak)
{
    SmallScene small = one_flake(6, 6);
    small.scene.sky.ambient = {0, 0, 0};
    scene::Light lamp;
    lamp.kind = scene::LightKind::point;
    lamp.g = 0.77;
    lamp.intensity = {100, 100, 100};
    lamp.position_m = {20, 18, 5};  // 10 m behind it
    small.scene.lights = {lamp};
    const double behind = sum_of(draw(small), 0);
    small.scene.lights[0].position_m = {20, -2, 5};  // 10 m before it
    const double before = sum_of(draw(small), 0);
    EXPECT_NEAR(behind / before, std::pow((1 + 0.77) / (1 - 0.77), 3), 0.01 * behind / before);
}

TEST(Reference, ColourOfAFlakeIsPhaseTimesIrradiance)
{
    SmallScene small = one_flake(6, 6);
    small.scene.sky.ambient = {0.25F, 0, 0};
    small.scene.render.sprite = scene::Sprite::point;
    small.scene.render.flake_opacity = 1;
    scene::Light lamp;
    lamp.kind = scene::LightKind::directional;
    lamp.direction = {0, 0, -1};
    lamp.g = 0.5;
    lamp.intensity = {2, 4, 8};
    small.scene.lights = {lamp};
    small.scene.render.blending = scene::Blending::opaque;
    const image::Image picture = draw(small);
    const double phase = (1 - 0.25) / (4 * std::numbers::pi * std::pow(0.25 + 2 * 0.5 * (1 - 0), 1.5));
    // The disc's middle lies on the corner of four pixels, which it covers.
    EXPECT_NEAR(picture.pixel(80, 60)[0], 0.25 + 2 * phase, 1e-6);
    EXPECT_NEAR(picture.pixel(79, 59)[1], 4 * phase, 1e-6);
    EXPECT_NEAR(picture.pixel(80, 59)[2], 8 * phase, 1e-6);
    EXPECT_EQ(picture.pixel(100, 60)[2], 0);
}

TEST(Reference, ImposterKeepsTheLightOfTheDisc)
{
    // A lamp at the side: the lit half brightens by what the dark half loses.
    SmallScene small = one_flake(1, 30);
    small.scene.sky.ambient = {0, 0, 0};
    scene::Light lamp;
    lamp.kind = scene::LightKind::directional;
    lamp.direction = {-1, 0, 0};
    lamp.intensity = {5, 5, 5};
    small.scene.lights = {lamp};
    const image::Image picture = draw(small);
    double left = 0, right = 0;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 80; ++x)
        {
            left += picture.pixel(x, y)[0];
            right += picture.pixel(159 - x, y)[0];
        }
    EXPECT_GT(right, 1.05 * left);
}

TEST(Reference, WallHidesWhatIsBehindIt)
{
    SmallScene small = flakes_by_a_wall(0);
    const image::Image without = draw(small);
    small.flakes.add({16, 20, 4}, kLargeFlake);
    enlarge(small, 20);
    EXPECT_EQ(draw(small).rgba, without.rgba);
    small.flakes.y[0] = 10;
    EXPECT_NE(draw(small).rgba, without.rgba);
}

TEST(Reference, OrderOfSlotsDoesNotMatter)
{
    SmallScene small = flakes_by_a_wall(300);
    enlarge(small, 20);
    light_up(small);
    const image::Image forwards = draw(small);
    for (auto* array : {&small.flakes.x, &small.flakes.y, &small.flakes.z})
        std::reverse(array->begin(), array->end());
    std::reverse(small.flakes.id.begin(), small.flakes.id.end());
    EXPECT_EQ(draw(small).rgba, forwards.rgba);
}

TEST(Reference, OffAndMissingLampsAndTheDarkHalfOfAFlashGiveNothing)
{
    SmallScene lit = flakes_by_a_wall(100);
    light_up(lit);
    lit.time_s = 1.8;  // frac(1.8 * 2 + 0.25) = 0.85: dark
    SmallScene without = lit;
    without.scene.lights.resize(3);
    EXPECT_EQ(draw(lit).rgba, draw(without).rgba);
    lit.time_s = 1.6;
    without.time_s = 1.6;
    EXPECT_NE(draw(lit).rgba, draw(without).rgba);
}

TEST(Reference, DeadFlakesAreNotDrawn)
{
    SmallScene small = one_flake(3, 10);
    const double alive = sum_of(draw(small), 0);
    small.flakes.state[0] = static_cast<std::uint32_t>(Fate::landed) | 3U << 8U;
    EXPECT_GT(alive, 0);
    EXPECT_EQ(sum_of(draw(small), 0), 0);
}

}  // namespace
}  // namespace spindrift::golden
