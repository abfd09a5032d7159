// SPDX-License-Identifier: MIT
// Flakes dim the light that passes them: the slices of the GPU against the exact sum over all discs, and both
// against exp(-number x area x length).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <random>

#include "gl/context.h"
#include "reference/reference.h"
#include "scene/flake_shade.h"
#include "tests/golden/gl_picture.h"
#include "tests/golden/small_scenes.h"

namespace spindrift::golden
{
namespace
{

constexpr int kFlakes = 20000;
constexpr double kLow_m = 5, kHigh_m = 20;

/// Flakes from 5 m to 20 m, an eye below them that looks at the ground, and no light but one lamp's.
SmallScene below_snow()
{
    SmallScene small = empty_scene();
    add_ground(small);
    enlarge(small, 120);
    small.world.snow.rate_mm_h = 5;
    small.scene.snow = small.world.snow;
    small.scene.sky.ambient = {0, 0, 0};
    small.scene.shadows.snow_slices = 8;
    small.view.eye = {20, 20, 3};
    small.view.forward = {0, 0, -1};
    small.view.up = {0, 1, 0};
    small.view.tan_half_fov_y = 2;
    small.view.width_px = small.scene.render.width_px = 80;
    small.view.height_px = small.scene.render.height_px = 60;
    std::mt19937 random(11);
    const auto unit = [&random] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
    for (std::uint32_t i = 0; i < kFlakes; ++i)
        small.flakes.add({40 * unit(), 40 * unit(), static_cast<float>(kLow_m + (kHigh_m - kLow_m) * unit())},
                         i);
    return small;
}

scene::Light sun()
{
    scene::Light light;
    light.kind = scene::LightKind::directional;
    light.direction = {0, 0.6, -0.8};
    light.intensity = {1, 1, 1};
    light.shadow = true;
    return light;
}

double mean(const image::Image& picture)
{
    double sum = 0;
    for (std::size_t i = 1; i < picture.rgba.size(); i += 4) sum += double{picture.rgba[i]};
    return sum / static_cast<double>(picture.rgba.size() / 4);
}

class SnowShade : public testing::Test
{
  protected:
    static void SetUpTestSuite() { context_ = gl::make_headless_context(); }
    static void TearDownTestSuite() { context_.reset(); }

    static double drawn(SmallScene& small)
    {
        const GlPicture picture = draw_with_gl(small);
        EXPECT_EQ(picture.errors, "");
        return mean(picture.linear);
    }
    static double exact(SmallScene& small)
    {
        return mean(reference::render(small.scene, small.geometry, small.world, small.flakes.view(),
                                      small.flakes.x.size(), small.view, small.time_s));
    }
    /// Share of the light that is left, by the slices and exactly.
    static void check(SmallScene small, const char* name, double expected, double tolerance,
                      double most_off = 0.02)
    {
        const double dimmed = drawn(small), truth = exact(small);
        small.scene.shadows.snow_slices = 0;
        const double bright = drawn(small);
        std::printf("%s: share of the light by slices %.4f, exactly %.4f, by number and area %.4f\n", name,
                    dimmed / bright, truth / bright, expected);
        EXPECT_NEAR(dimmed / truth, 1, most_off);
        EXPECT_NEAR(truth / bright, expected, tolerance);
    }
    static std::unique_ptr<gl::Context> context_;
};
std::unique_ptr<gl::Context> SnowShade::context_;

// Some 5000 flakes are on the ways to the picture; squared sizes scatter by a factor of sqrt(20): 6 % of the
// optical depth, and twice as much is allowed.
constexpr double kChance = 0.12;

TEST_F(SnowShade, DimsTheSunByNumberAndAreaOfItsFlakes)
{
    SmallScene small = below_snow();
    small.scene.lights = {sun()};
    const double area_m2 = scene::full_flake_area_m2(small.scene.render, small.scene.snow);
    const double depth = kFlakes / (40.0 * 40.0) * area_m2 / 0.8;  // over the height, along the slant
    check(small, "sun", std::exp(-depth), kChance * depth * std::exp(-depth));
}

TEST_F(SnowShade, DimsASpotInClearAirAndLeavesItToTheFogInThickAir)
{
    SmallScene small = below_snow();
    scene::Light lamp = sun();
    lamp.kind = scene::LightKind::spot;
    lamp.position_m = {20, 20, 25};
    lamp.direction = {0, 0, -1};
    lamp.intensity = {100, 100, 100};
    lamp.inner_cone_deg = 30;
    lamp.outer_cone_deg = 50;
    small.scene.lights = {lamp};
    const double area_m2 = scene::full_flake_area_m2(small.scene.render, small.scene.snow);
    const double depth = kFlakes / (40.0 * 40.0 * 15.0) * area_m2 * 15;
    check(small, "spot", std::exp(-depth), 0.2,
          0.04);  // ways aslant are longer, and some discs cover much of what it sees
    small.scene.air.source = scene::AirSource::visibility;
    small.scene.air.visibility_m = 100;
    const double thick = drawn(small);
    small.scene.shadows.snow_slices = 0;
    EXPECT_EQ(thick, drawn(small)) << "the extinction of all snow counts these flakes already";
}

}  // namespace
}  // namespace spindrift::golden
