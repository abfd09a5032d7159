// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/snow.h"
#include "scene/crystals.h"
#include "tests/gl/stage.h"

namespace spindrift::gl
{
namespace
{

using scene::Blending;
using scene::Sprite;

constexpr double kSigma = 0.45;

/// A place whose projection is the middle of pixel (column, row) counted from the top, at a depth.
Vec3f at_pixel(const View& view, int column, int row, double depth_m)
{
    const double focal_px = view.height_px / (2.0 * view.tan_half_fov_y);
    return {static_cast<float>((column + 0.5 - 0.5 * view.width_px) * depth_m / focal_px),
            static_cast<float>(depth_m),
            static_cast<float>((0.5 * view.height_px - row - 0.5) * depth_m / focal_px)};
}

struct FlakeSprite : testing::Test, Stage
{
    FlakeSprite() { scene.sky.ambient = {1, 1, 1}; }

    /// Depth at which a flake appears with this radius.
    double depth_for(std::uint32_t id, double wanted_px) const { return radius_px(id, 1.0) / wanted_px; }
    std::size_t shape_of(std::uint32_t id) const;
};

TEST_F(FlakeSprite, PointHasItsRadianceAndCoverageAtTheCentre)
{
    scene.render.sprite = Sprite::point;
    scene.sky.zenith = scene.sky.horizon = {0.25F, 0.5F, 1.0F};
    scene.sky.ambient = {2, 1, 0.5F};
    const std::uint32_t id = id_of_diameter(0.004);
    add_flake(at_pixel(view, 48, 32, depth_for(id, 5)), id);
    const image::Image image = draw();
    const float* centre = image.pixel(48, 32);
    // A plain disc hides all but 1e-4 of what is behind it.
    EXPECT_NEAR(centre[0], 2, 1e-2);
    EXPECT_NEAR(centre[1], 1, 1e-2);
    EXPECT_NEAR(centre[2], 0.5, 1e-2);
    const float* outside = image.pixel(48 + 7, 32);
    EXPECT_NEAR(outside[0], 0.25, 1e-3);
    EXPECT_NEAR(outside[2], 1.0, 1e-3);
    for (const int offset : {-4, 4}) EXPECT_GT(image.pixel(48 + offset, 32)[0], 1.9) << "radius is 5 px";
    for (const int offset : {-6, 6}) EXPECT_LT(image.pixel(48 + offset, 32)[0], 0.3);
}

TEST_F(FlakeSprite, SmallFlakeFollowsTheGaussianTimesTheMeanMask)
{
    const std::vector<scene::CrystalMask>& masks = scene::crystal_masks();
    for (const double diameter : {0.003, 0.005, 0.008, 0.012})
    {
        places.clear();
        ids.clear();
        const std::uint32_t id = id_of_diameter(diameter);
        const double r = 2.5;
        add_flake(at_pixel(view, 48, 32, depth_for(id, r)), id);
        const image::Image image = draw();
        const double mean = masks[shape_of(id)].mean;
        for (int dx = -3; dx <= 3; ++dx)
        {
            const double rho = dx / r;
            const double expected =
                std::abs(rho) > 1 ? 0 : 0.8 * mean * std::exp(-rho * rho / (2 * kSigma * kSigma));
            EXPECT_NEAR(image.pixel(48 + dx, 32)[0], expected, 1e-2) << dx;
        }
    }
}

std::size_t FlakeSprite::shape_of(std::uint32_t id) const
{
    return flake_turn(world.seed, id, scene::kCrystalShapes).shape;
}

TEST_F(FlakeSprite, LargeFlakeShowsItsTurnedCrystal)
{
    const std::vector<scene::CrystalMask>& masks = scene::crystal_masks();
    const std::uint32_t id = id_of_diameter(0.012);
    const double r = 24;
    const double time_s = 3.5;
    add_flake(at_pixel(view, 48, 32, depth_for(id, r)), id);
    const image::Image image = draw_and_keep("crystal", time_s);
    const double angle = 2 * M_PI * flake_turn(world.seed, id, scene::kCrystalShapes).turns_at(time_s);
    double worst = 0;
    double sum = 0;
    for (int row = 32 - 26; row <= 32 + 26; ++row)
        for (int column = 48 - 26; column <= 48 + 26; ++column)
        {
            const double px = (column - 48) / r;
            const double py = (32 - row) / r;
            const double rho2 = px * px + py * py;
            const double u = std::cos(angle) * px + std::sin(angle) * py;
            const double v = std::cos(angle) * py - std::sin(angle) * px;
            const double mask =
                scene::sample_mask(masks[shape_of(id)], u, v, std::max(0.0, std::log2(64 / r)));
            const double expected = rho2 > 1 ? 0 : 0.8 * std::exp(-rho2 / (2 * kSigma * kSigma)) * mask;
            const double off = std::abs(expected - static_cast<double>(image.pixel(column, row)[0]));
            worst = std::max(worst, off);
            sum += off;
        }
    EXPECT_LT(worst, 0.03);
    EXPECT_LT(sum / (53 * 53), 2e-3);
}

TEST_F(FlakeSprite, TinyFlakesKeepTheirCoverage)
{
    // Far below a pixel the sum over the picture falls with the square of the distance, as the true solid
    // angle does.
    const std::uint32_t id = id_of_diameter(0.004);
    add_flake(at_pixel(view, 48, 32, depth_for(id, 0.6)), id);
    const double near_sum = total(draw());
    places[0] = at_pixel(view, 48, 32, depth_for(id, 0.2));
    const double far_sum = total(draw());
    EXPECT_NEAR(near_sum / far_sum, 9.0, 0.1);
}

TEST_F(FlakeSprite, WeightDeepensOpticalDepth)
{
    world.snow.weight = 4;
    const std::uint32_t id = id_of_diameter(0.004);
    const std::vector<scene::CrystalMask>& masks = scene::crystal_masks();
    add_flake(at_pixel(view, 48, 32, depth_for(id, 2.0)), id);
    const double opacity = 0.8 * masks[shape_of(id)].mean;
    EXPECT_NEAR(draw().pixel(48, 32)[0], 1 - std::pow(1 - opacity, 4), 1e-2);
    // Twice the size for the same weight: each stands for a quarter of the optical depth.
    scene.render.flake_scale = 2;
    places[0] = at_pixel(view, 48, 32, depth_for(id, 2.0));
    EXPECT_NEAR(draw().pixel(48, 32)[0], opacity, 1e-2);
}

TEST_F(FlakeSprite, OverDependsOnOrderAdditiveDoesNot)
{
    scene.render.sprite = Sprite::point;
    scene.lights.push_back(point_light({-50, 0.3, 0}, 3e4));
    scene.lights.back().g = 0;
    scene.sky.ambient = {0, 0, 0};
    scene::Light other = scene.lights.back();
    const std::uint32_t big = id_of_diameter(0.006);
    const double depth = depth_for(big, 2.5);
    // Half transparent: close to the near plane's fade.
    view.near_m = static_cast<float>(depth / 2.5);
    add_flake(at_pixel(view, 48, 32, depth), big);
    const double one = draw().pixel(48, 32)[0];
    add_flake(at_pixel(view, 48, 32, depth), big);
    const double two_over = draw().pixel(48, 32)[0];
    scene.render.blending = Blending::additive;
    const double two_added = draw().pixel(48, 32)[0];
    EXPECT_NEAR(two_added, 2 * one, 0.02 * one);
    // L a + L a (1 - a) with a = 1/2.
    EXPECT_NEAR(two_over, 1.5 * one, 0.03 * one);
}

TEST_F(FlakeSprite, OrderOfTheListIsTheOrderOfBlending)
{
    scene.render.sprite = Sprite::point;
    scene.sky.ambient = {0, 0, 0};
    // Only the flake at the lamp is bright; nearly opaque discs.
    scene.lights.push_back(point_light({0, 5.5, 0}, 10));
    scene.lights.back().range_m = 1;
    scene.lights.back().g = 0;
    const std::uint32_t id = id_of_diameter(0.012);
    const Vec3f lit = at_pixel(view, 48, 32, 6);
    const Vec3f dark = at_pixel(view, 48, 32, 4);
    add_flake(lit, id);
    add_flake(dark, id);
    const double hidden = draw().pixel(48, 32)[0];
    std::swap(places[0], places[1]);
    const double seen = draw().pixel(48, 32)[0];
    EXPECT_GT(seen, 1.0);
    EXPECT_LT(hidden, 0.01 * seen);
}

TEST_F(FlakeSprite, OpaquePointsUseTheDepthBufferInAnyOrder)
{
    scene.render.blending = Blending::opaque;
    scene.sky.ambient = {0, 0, 0};
    scene.lights.push_back(point_light({0, 5.5, 0}, 10));
    scene.lights.back().range_m = 1;
    scene.lights.back().g = 0;
    const std::uint32_t id = id_of_diameter(0.012);
    add_flake(at_pixel(view, 48, 32, 6), id);
    add_flake(at_pixel(view, 48, 32, 4), id);
    EXPECT_EQ(draw().pixel(48, 32)[0], 0);
    std::swap(places[0], places[1]);
    EXPECT_EQ(draw().pixel(48, 32)[0], 0);
    sorted = false;
    EXPECT_EQ(draw().pixel(48, 32)[0], 0);
    places = {places[1]};
    ids = {id};
    EXPECT_GT(draw().pixel(48, 32)[0], 1);
}

TEST_F(FlakeSprite, CrossesTheBorderWithoutPopping)
{
    const std::uint32_t id = id_of_diameter(0.018);
    for (const int towards : {-1, 1})
    {
        double last = -1;
        double biggest_step = 0;
        double biggest = 0;
        const double depth = depth_for(id, 20);
        // From 24 px inside to 24 px outside, in half pixels.
        for (int step = -48; step <= 48; ++step)
        {
            const double column = (towards < 0 ? 0.0 : 96.0) + towards * step * 0.5;
            const double focal_px = view.height_px / (2.0 * view.tan_half_fov_y);
            places = {{static_cast<float>((column - 48) * depth / focal_px), static_cast<float>(depth), 0}};
            ids = {id};
            const double sum = total(draw());
            if (last >= 0) biggest_step = std::max(biggest_step, std::abs(sum - last));
            biggest = std::max(biggest, sum);
            last = sum;
        }
        EXPECT_GT(biggest, 50);
        EXPECT_LT(biggest_step, 0.06 * biggest) << "half a pixel of a disc of 40 px";
        EXPECT_NEAR(last, 0, 1e-6);
    }
}

TEST_F(FlakeSprite, GuardBandDoesNotMoveThePicture)
{
    add_flake(at_pixel(view, 20, 50, 0.8), id_of_diameter(0.01));
    add_flake(at_pixel(view, 70, 10, 3.0), id_of_diameter(0.006));
    const image::Image wide = draw();
    view.guard_px = 32;
    const image::Image narrow = draw();
    for (std::size_t i = 0; i < wide.rgba.size(); ++i) ASSERT_NEAR(wide.rgba[i], narrow.rgba[i], 0.02) << i;
}

TEST_F(FlakeSprite, RadiusStopsAtTheGuardBand)
{
    view.guard_px = 16;
    scene.render.sprite = Sprite::point;
    const std::uint32_t id = id_of_diameter(0.018);
    view.near_m = 0.001F;
    add_flake(at_pixel(view, 48, 32, depth_for(id, 100)), id);
    const image::Image image = draw();
    EXPECT_GT(image.pixel(48 + 15, 32)[0], 0.5);
    EXPECT_EQ(image.pixel(48 + 18, 32)[0], 0);
}

TEST_F(FlakeSprite, PlainAndCrystalShadersAgreeBelowThreePixels)
{
    // Unsorted lists go through the full shader, sorted far ones through the lean one.
    for (int i = 0; i < 40; ++i)
        add_flake(at_pixel(view, 8 + 2 * i, 10 + i, 6.0 + 0.2 * (40 - i)), static_cast<std::uint32_t>(i));
    const image::Image lean = draw();
    sorted = false;
    const image::Image full = draw();
    EXPECT_GT(total(lean), 0.3);
    for (std::size_t i = 0; i < lean.rgba.size(); ++i) ASSERT_NEAR(lean.rgba[i], full.rgba[i], 2e-3) << i;
}

TEST_F(FlakeSprite, BuffersThatTheHostCannotReadGiveTheSamePicture)
{
    // Some beyond the border between the two shaders (2.3 m here), some within; then all on one side of it.
    for (const double nearest_m : {0.6, 4.0, 0.05})
        for (const Blending blending : {Blending::over, Blending::opaque})
        {
            places.clear();
            ids.clear();
            scene.render.blending = blending;
            for (int i = 0; i < 40; ++i)
                add_flake(at_pixel(view, 8 + 2 * i, 10 + i, nearest_m * (1 + 0.15 * (40 - i))),
                          static_cast<std::uint32_t>(i));
            const image::Image mapped = draw();
            const image::Image unmapped = draw(0, FlakeBuffers::Access::unmapped);
            EXPECT_GT(total(mapped), 0.1);
            EXPECT_EQ(mapped.rgba, unmapped.rgba) << nearest_m;
        }
}

TEST_F(FlakeSprite, NonFinitePlacesDrawNothing)
{
    scene.lights.push_back(point_light({0, 2, 0}, 100));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    for (const Vec3f& bad :
         {Vec3f{nan, 2, 0}, Vec3f{0, nan, 0}, Vec3f{0, 2, nan}, Vec3f{inf, 2, 0}, Vec3f{0, inf, 0},
          Vec3f{0, 2, -inf}, Vec3f{nan, nan, nan}, Vec3f{3e38F, 3e38F, 3e38F}})
        add_flake(bad, 7);
    const image::Image image = draw();
    EXPECT_TRUE(all_finite(image));
    EXPECT_EQ(total(image), 0);
}

TEST_F(FlakeSprite, ExtremesStayFinite)
{
    // On the lamp, on the eye, at the near plane, straight in a needle-sharp forward peak.
    scene.lights.push_back(point_light({0, 2, 0}, 1e9));
    scene.lights.back().g = 0.99999;
    scene.lights.push_back(scene.lights.back());
    scene.lights.back().g = -0.99999;
    add_flake({0, 2, 0}, 1);
    add_flake({0, 1, 0}, 2);
    add_flake({0, 0, 0}, 3);
    add_flake({0, view.near_m, 0}, 4);
    add_flake({0, view.near_m * 1.001F, 0}, 5);
    for (const Blending blending : {Blending::over, Blending::additive, Blending::opaque})
    {
        scene.render.blending = blending;
        const image::Image image = draw();
        EXPECT_TRUE(all_finite(image) || blending == Blending::additive);
        for (const float v : image.rgba) ASSERT_FALSE(std::isnan(v));
    }
}

TEST_F(FlakeSprite, NoFlakesLeaveTheSky)
{
    scene.sky.zenith = scene.sky.horizon = {0.25F, 0.5F, 1.0F};
    const image::Image image = draw();
    for (int i = 0; i < 96 * 64; ++i) ASSERT_NEAR(image.rgba[static_cast<std::size_t>(i) * 4 + 1], 0.5, 1e-3);
}

}  // namespace
}  // namespace spindrift::gl
