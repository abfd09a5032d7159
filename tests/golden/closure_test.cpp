// SPDX-License-Identifier: MIT
// How much drawn flakes and fog hide together, measured on pictures, against exp(-beta d).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "core/air.h"
#include "gl/context.h"
#include "scene/air.h"
#include "tests/golden/gl_picture.h"
#include "tests/golden/small_scenes.h"

namespace spindrift::golden
{
namespace
{

// Large flakes near the eye are few, and each hides much: that scatters what a picture lets through by
// sqrt(20 / (flakes per m3 · solid angle · nearest depth)) / distance of its optical depth (20: spread of the
// squared sizes). So the lens is wide, nearer ones than 1 m are left to the fog, and several skies are
// averaged.
constexpr int kFlakes = 250000;
constexpr double kEnlargement = 30;

/// A sky full of flakes of which one stands for kEnlargement² of its size, 40 x 40 x 20 m round the eye.
SmallScene snowfall()
{
    SmallScene small = empty_scene();
    enlarge(small, kEnlargement);
    small.world.snow.rate_mm_h = 5;
    small.scene.snow = small.world.snow;
    small.view.eye = {20, 20, 10};
    small.view.tan_half_fov_y = 1;
    small.view.near_m = 1;
    small.view.far_m = 400;
    scene::EmitterSettings sky;
    sky.emitter.shape = EmitterShape::sky;
    sky.a = {20, 20, 10};
    sky.b = {40, 40, 20};
    sky.emitter.burst = kFlakes;
    small.scene.emitters.push_back(sky);
    return small;
}

void fill(SmallScene& small, unsigned seed)
{
    std::mt19937 random(seed);
    const auto unit = [&random] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
    small.flakes = {};
    for (std::uint32_t i = 0; i < kFlakes; ++i)
        small.flakes.add({40 * unit(), 40 * unit(), 20 * unit()}, (seed << 24) + i);
}

/// A dome round the eye, so that every pixel is as far: its left half of one radiance, its right half of the
/// other.
void add_dome(SmallScene& small, double distance_m, float left, float right)
{
    constexpr int cells = 160;  // over 160 degrees
    small.geometry.meshes.clear();
    small.scene.boxes.assign(1, {});  // so that the frame plan knows of it
    scene::Mesh mesh;
    mesh.materials = {{{0, 0, 0}, {left, left, left}, 1, 0}, {{0, 0, 0}, {right, right, right}, 1, 0}};
    mesh.parts = {{0, {}}, {1, {}}};
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column)
        {
            const double up = (row - 0.5 * cells) * std::numbers::pi / 180;
            const double aside = (column - 0.5 * cells) * std::numbers::pi / 180;
            const Vec3f way{static_cast<float>(std::sin(aside) * std::cos(up)),
                            static_cast<float>(std::cos(aside) * std::cos(up)),
                            static_cast<float>(std::sin(up))};
            mesh.vertices.push_back({small.view.eye + way * static_cast<float>(distance_m), way * -1.0F});
        }
    for (std::uint32_t row = 0; row < cells; ++row)
        for (std::uint32_t column = 0; column < cells; ++column)
        {
            const std::uint32_t first = row * (cells + 1) + column;
            auto& indices = mesh.parts[column < cells / 2 ? 0 : 1].indices;
            for (const std::uint32_t k : {0U, 1U, cells + 2U, 0U, cells + 2U, cells + 1U})
                indices.push_back(first + k);
        }
    small.geometry.meshes.push_back(mesh);
}

/// Mean over the pixels of some columns.
double mean(const image::Image& picture, int first, int last)
{
    double sum = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = first; x < last; ++x) sum += static_cast<double>(picture.pixel(x, y)[1]);
    return sum / ((last - first) * picture.height);
}

/// Mean over the pixels of f(share of a unit way that goes up, its cosine to the view's forward).
template <class Function>
double over_pixels(const View& view, const Function& f)
{
    const double focal_px = view.height_px / (2.0 * view.tan_half_fov_y);
    double sum = 0;
    for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x)
        {
            const double right = (x + 0.5 - 0.5 * view.width_px) / focal_px;
            const double up = (0.5 * view.height_px - y - 0.5) / focal_px;
            const double cosine = 1 / std::sqrt(1 + right * right + up * up);
            sum += f(up * cosine, cosine);
        }
    return sum / (view.width_px * view.height_px);
}

/// exp(-optical depth of all snow) up to the dome.
double expected(const SmallScene& small, double distance_m)
{
    const AirLayers<double> air = scene::layers_of(small.scene);
    const double eye = small.view.eye.z;
    return over_pixels(small.view, [&](double rise, double)
                       { return std::exp(-optical_depth(air, eye, eye + rise * distance_m, distance_m)); });
}

/// The same of flakes alone: sprites are discs on the picture and hide by depth.
double expected_by_depth(const SmallScene& small, double extinction, double distance_m)
{
    return over_pixels(small.view,
                       [&](double, double cosine) { return std::exp(-extinction * distance_m * cosine); });
}

image::Image draw(SmallScene& small)
{
    small.scene.render.flake_path = scene::FlakePath::tiles;
    GlPicture drawn = draw_with_gl(small);
    EXPECT_EQ(drawn.errors, "");
    return std::move(drawn.linear);
}

/// Compares what flakes and fog, themselves in the dark, let through of a glowing wall at several distances.
void check_distances(SmallScene small, const char* name, unsigned skies,
                     std::initializer_list<double> distances_m)
{
    small.scene.sky.ambient = {0, 0, 0};
    const scene::Air air = scene::air_at(small.scene, small.view, 0);
    const Vec3d eye{small.view.eye.x, small.view.eye.y, small.view.eye.z};
    const AirPath<double> ahead(air.layers, air.volume(), eye, {0, 1, 0}, 1);
    std::printf("%s\n| distance, m | transmittance | exp(-beta d) | error, %% | of it by flakes, %% |\n",
                name);
    // 20 m: where the flakes' volume ends
    for (const double d : distances_m)
    {
        add_dome(small, d, 1, 1);
        const double truth = expected(small, d);
        double seen = 0;
        for (unsigned sky = 1; sky <= skies; ++sky)
        {
            fill(small, sky);
            seen += mean(draw(small), 0, small.view.width_px) / skies;
        }
        std::printf("| %g | %.4f | %.4f | %+.2f | %.0f |\n", d, seen, truth, 100 * (seen / truth - 1),
                    100 * ahead.of_flakes(d) / ahead.of_all(d));
        EXPECT_NEAR(seen / truth, 1, 0.02) << d;
    }
}

/// Least-squares slope of -log(contrast) over the distance, 1/m.
double slope_of(const std::vector<double>& distances_m, const std::vector<double>& contrasts)
{
    double n = 0, sum_d = 0, sum_y = 0, sum_dd = 0, sum_dy = 0;
    for (std::size_t i = 0; i < distances_m.size(); ++i)
    {
        const double d = distances_m[i], y = -std::log(contrasts[i]);
        n += 1, sum_d += d, sum_y += y, sum_dd += d * d, sum_dy += d * y;
    }
    return (n * sum_dy - sum_d * sum_y) / (n * sum_dd - sum_d * sum_d);
}

/// Contrast of a black half of the dome beside one as bright as the flakes and the fog.
std::vector<double> contrasts(SmallScene small, const std::vector<double>& distances_m, unsigned skies)
{
    small.scene.sky.ambient = {1, 1, 1};
    std::vector<double> seen;
    for (const double d : distances_m)
    {
        add_dome(small, d, 0, 1);
        double dark = 0, bright = 0;
        const int middle = small.view.width_px / 2;
        for (unsigned sky = 1; sky <= skies; ++sky)
        {
            fill(small, sky);
            const image::Image picture = draw(small);
            dark += mean(picture, 0, middle);
            bright += mean(picture, middle, small.view.width_px);
        }
        seen.push_back((bright - dark) / bright);
        std::printf("  %5.1f m: contrast %.4f\n", d, seen.back());
    }
    return seen;
}

class Closure : public testing::Test
{
  protected:
    static void SetUpTestSuite() { context_ = gl::make_headless_context(); }
    static void TearDownTestSuite() { context_.reset(); }
    static std::unique_ptr<gl::Context> context_;
};
std::unique_ptr<gl::Context> Closure::context_;

TEST_F(Closure, FogGoesOnWhereTheFlakesEnd)
{
    SmallScene small = snowfall();
    small.scene.air.source = scene::AirSource::flakes;
    check_distances(small, "flakes state the extinction", 3, {3.0, 10.0, 19.5, 20.5, 70.0});
}

TEST_F(Closure, FogFillsWhatTooFewFlakesLeave)
{
    SmallScene small = snowfall();
    small.scene.air.source = scene::AirSource::visibility;
    small.scene.air.visibility_m = 60;
    check_distances(small, "visibility 60 m (5 %)", 3, {3.0, 19.5, 20.5, 70.0});
}

TEST_F(Closure, HoldsWithDriftingSnowAndFlakesThatStandForMore)
{
    SmallScene small = snowfall();
    small.world.snow.weight *= 2;
    small.scene.snow = small.world.snow;
    small.view.eye.z = 2;
    small.scene.air.source = scene::AirSource::flakes;
    small.scene.air.drift_visibility_m = 40;
    small.scene.air.drift_height_m = 1.5;
    check_distances(small, "with drift", 8, {10.0, 20.5, 40.0});
}

TEST_F(Closure, ContrastFallsByTheFlakesThemselves)
{
    SmallScene small = snowfall();
    small.scene.air.source = scene::AirSource::flakes;
    const double extinction = scene::uniform_extinction(small.scene);
    // Nothing but flakes, behind those that fade out before the eye and before the lid of their volume.
    small.scene.air.source = scene::AirSource::clear;
    const std::vector<double> distances{6, 10, 14};
    std::vector<double> truth;
    for (const double d : distances) truth.push_back(expected_by_depth(small, extinction, d));
    const double slope = slope_of(distances, contrasts(small, distances, 10));
    const double wanted = slope_of(distances, truth);
    std::printf("flakes alone: slope %.5f 1/m, by their area %.5f 1/m, %+.2f %%\n", slope, wanted,
                100 * (slope / wanted - 1));
    EXPECT_NEAR(slope / wanted, 1, 0.02);
}

TEST_F(Closure, ContrastAtTheVisibilityIsWhatDefinesIt)
{
    SmallScene small = snowfall();
    small.scene.air.source = scene::AirSource::visibility;
    small.scene.air.visibility_m = 80;
    small.scene.sky.horizon = {1, 1, 1};
    const std::vector<double> distances{8, 25, 80};
    const double slope = slope_of(distances, contrasts(small, distances, 3));
    const double extinction = 2.995732 / 80;
    std::printf("flakes and fog: slope %.5f 1/m, 2.996 / visibility %.5f 1/m, %+.2f %%\n", slope, extinction,
                100 * (slope / extinction - 1));
    EXPECT_NEAR(slope / extinction, 1, 0.02);
}

}  // namespace
}  // namespace spindrift::golden
