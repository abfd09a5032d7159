// SPDX-License-Identifier: MIT
#include "cpu/tile_splatter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tests/core/glow_nodes.h"

namespace spindrift::cpu
{
namespace
{

// How sprites look is held against the reference renderer in tests/golden; here: every variant gives the same
// bits, and the borders of tiles and picture.

constexpr int kWidth = 101, kHeight = 75;  // neither full tiles nor full packs
constexpr std::size_t kPixels = static_cast<std::size_t>(kWidth) * kHeight;

double from_half(std::uint16_t bits)
{
    const int exponent = bits >> 10 & 31, fraction = bits & 1023;
    return exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
}

/// Flakes in front of a camera that looks along +y, and a picture of many greys.
struct Splash
{
    std::vector<float> x, y, z;
    std::vector<std::uint32_t> ids;
    std::vector<std::uint64_t> pairs;
    std::vector<std::uint8_t> texels, noise;
    std::vector<std::uint16_t> tone;  ///< in 1/256 of a level
    std::vector<float> depth;
    std::vector<std::uint16_t> rgba;
    std::vector<std::uint8_t> display;
    std::vector<Lamp<float>> lamps;
    std::vector<Vec3f> velocities;
    std::vector<float> shade_area_m2, shade_integral_m3;
    std::vector<float> glow;
    std::vector<std::int32_t> grid_of_lamp;
    SplatJob job;

    explicit Splash(std::size_t flakes) : depth(kPixels), rgba(kPixels * 4), display(kPixels * 4)
    {
        std::mt19937 random(11);
        const auto unit = [&random] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
        for (std::size_t i = 0; i < flakes; ++i)
        {
            const float away = 1 + 20 * unit();
            x.push_back((unit() - 0.5F) * 1.6F * away);
            y.push_back(away);
            z.push_back((unit() - 0.5F) * 1.2F * away);
            ids.push_back(static_cast<std::uint32_t>(random()));
            pairs.push_back(i);
        }
        for (std::size_t i = 0; i < kPixels; ++i)
        {
            depth[i] = i % 7 == 0 ? 0 : 0.005F + 0.05F * unit();
            // Denormal halves, ordinary ones up to 4, and 1 as alpha.
            for (std::size_t c = 0; c < 3; ++c)
                rgba[4 * i + c] = static_cast<std::uint16_t>(random() % 0x4400U);
            rgba[4 * i + 3] = 0x3C00;
        }
        for (std::size_t i = 0; i < 4096 + 1024 + 3; ++i)
            texels.push_back(static_cast<std::uint8_t>(random()));
        for (std::size_t i = 0; i < 0x8000; ++i) tone.push_back(static_cast<std::uint16_t>(2 * i % 65281));
        for (std::size_t i = 0; i < kPixels; ++i) noise.push_back(static_cast<std::uint8_t>(random()));
        lamps = {{LampKind::point,
                  {2, 9, 1},
                  {0, 0, -1},
                  {80, 60, 20},
                  40,
                  1,
                  0,
                  {PhaseKind::henyey_greenstein, 0.7F}},
                 {LampKind::directional,
                  {},
                  {0.6F, 0, -0.8F},
                  {0.2F, 0.3F, 0.4F},
                  1,
                  1,
                  0,
                  {PhaseKind::schlick, -0.2F}},
                 {LampKind::spot,
                  {-3, 12, 4},
                  {0.6F, 0, -0.8F},
                  {90, 90, 90},
                  30,
                  0.9F,
                  0.7F,
                  {PhaseKind::double_lobe, 0.8F, -0.3F, 0.2F}}};
        describe();
    }

    void describe()
    {
        job.view.width_px = kWidth;
        job.view.height_px = kHeight;
        job.time_s = 3.7;
        job.flake_scale = 60;
        job.flake_opacity = 0.9F;
        job.real_flakes = 1.6F;
        job.ambient = {0.1F, 0.2F, 0.3F};
        job.crystals.texels = texels.data();
        // One shape of 64 x 64 texels, its next level, and the same few texels for all others.
        job.crystals.size_log2 = 6;
        for (int level = 1; level < 8; ++level) job.crystals.level_start[level] = 4096;
        job.crystals.means[0] = 0.5F;
        job.flakes.x = x.data(), job.flakes.y = y.data(), job.flakes.z = z.data(), job.flakes.id = ids.data();
        job.pairs = pairs.data();
        job.count = pairs.size();
        job.lamps = lamps.data();
        job.lamp_count = lamps.size();
    }

    /// Fog and the lamps' glow in it before the flakes, whose volume begins behind the eye and ends before
    /// the last.
    void thicken()
    {
        for (int i = 0; i < 64; ++i)
        {
            shade_area_m2.push_back(1e-3F * static_cast<float>(i % 9));
            shade_integral_m3.push_back(1e-3F * static_cast<float>(i));
        }
        job.air.thick = job.air.glows = true;
        job.air.layers = {0.05F, 0.1F, 0.7F, -1};
        job.air.volume = {
            {-4, -1, -3}, {5, 14, 3}, 2, {shade_area_m2.data(), shade_integral_m3.data(), 64, -3, 8}};
    }

    /// The glow of the first lamp by a grid, in an even air; without the others, which have none.
    void look_glow_up()
    {
        Lamp<double> lamp;
        lamp.position_m = {2, 9, 1};
        lamp.intensity = {1, 1, 1};
        lamp.range_m = 40;
        lamp.phase.g = 0.7F;
        job.air.layers = {0.05F, 0, 1, 0};
        job.air.volume = {};
        job.lamp_count = 1;
        glow = glow_nodes(lamp, {},
                          [](const Vec3d& way) {
                              return AirPath<double>({0.05F, 0, 1, 0}, {}, {}, way, way.y);
                          });
        grid_of_lamp = {0};
        job.glow = {grid_of_lamp.data(), glow.data()};
    }

    /// Every flake on a way of its own while the shutter is open.
    void let_fly()
    {
        for (std::size_t i = 0; i < pairs.size(); ++i)
        {
            const float turn = static_cast<float>(i % 97);
            velocities.push_back({5 - 0.1F * turn, 0.03F * turn, -2 + 0.02F * turn});
        }
        job.shutter_s = 0.02F;
        job.velocities = velocities.data();
    }

    void splat(const CpuOptions& options)
    {
        make_tile_splatter(options)->splat(
            job, {kWidth, kHeight, depth.data(), rgba.data(), tone.data(), noise.data(), display.data()});
    }
};

TEST(TileSplatter, GivesTheSameBitsWithAnyThreadsAndInstructions)
{
    for (const SplatBlending blending :
         {SplatBlending::over, SplatBlending::additive, SplatBlending::weighted, SplatBlending::stochastic})
    {
        Splash truth(9000);
        const std::vector<std::uint16_t> before = truth.rgba;
        truth.job.blending = blending;
        truth.splat({1, Simd::scalar});
        EXPECT_NE(truth.rgba, before);
        for (const Simd simd : available_simd())
            for (const int threads : {1, 3})
            {
                Splash other(9000);
                other.job.blending = blending;
                other.splat({threads, simd});
                EXPECT_EQ(other.rgba, truth.rgba) << simd_name(simd) << ", " << threads << " threads";
                EXPECT_EQ(other.display, truth.display) << simd_name(simd) << ", " << threads << " threads";
            }
    }
}

TEST(TileSplatter, GivesTheSameBitsInThickAir)
{
    Splash clear(3000), truth(3000);
    clear.splat({1, Simd::scalar});
    truth.thicken();
    truth.splat({1, Simd::scalar});
    EXPECT_NE(truth.rgba, clear.rgba);
    for (const Simd simd : available_simd())
    {
        Splash other(3000);
        other.thicken();
        other.splat({3, simd});
        EXPECT_EQ(other.rgba, truth.rgba) << simd_name(simd);
    }
}

TEST(TileSplatter, LooksUpGlowWithTheSameBits)
{
    Splash integrated(3000), truth(3000);
    for (Splash* splash : {&integrated, &truth})
    {
        splash->thicken();
        splash->look_glow_up();
    }
    integrated.job.glow = {};
    integrated.splat({1, Simd::scalar});
    truth.splat({1, Simd::scalar});
    EXPECT_NE(truth.rgba, integrated.rgba);
    double most = 0;  // eight points on each way are off by some per cent themselves
    for (std::size_t i = 0; i < truth.rgba.size(); ++i)
    {
        const double a = from_half(truth.rgba[i]), b = from_half(integrated.rgba[i]);
        most = std::max(most, std::abs(a - b) / std::max(b, 0.5));
    }
    EXPECT_LT(most, 0.05);
    for (const Simd simd : available_simd())
    {
        Splash other(3000);
        other.thicken();
        other.look_glow_up();
        other.splat({3, simd});
        EXPECT_EQ(other.rgba, truth.rgba) << simd_name(simd);
    }
}

TEST(TileSplatter, GivesTheSameBitsOfStreaks)
{
    Splash still(3000), truth(3000);
    still.splat({1, Simd::scalar});
    truth.let_fly();
    truth.splat({1, Simd::scalar});
    EXPECT_NE(truth.rgba, still.rgba);
    for (const Simd simd : available_simd())
    {
        Splash other(3000);
        other.let_fly();
        other.splat({3, simd});
        EXPECT_EQ(other.rgba, truth.rgba) << simd_name(simd);
    }
}

TEST(TileSplatter, DevelopsAPictureWithoutFlakes)
{
    for (const Simd simd : available_simd())
    {
        Splash empty(0);
        const std::vector<std::uint16_t> before = empty.rgba;
        empty.splat({2, simd});
        EXPECT_EQ(empty.rgba, before);
        for (std::size_t i = 0; i < kPixels * 4; ++i)
        {
            const int level = (empty.tone[before[i]] + empty.noise[i / 4]) >> 8;
            ASSERT_EQ(empty.display[i], i % 4 == 3 ? 255 : level) << i;
        }
    }
}

TEST(TileSplatter, LeavesAloneWhatNoFlakeTouches)
{
    // One flake of 2 px on the corner of four tiles: halves that are read, blended with nothing and written
    // stay.
    for (const Simd simd : available_simd())
    {
        Splash one(1);
        one.x[0] = (64.0F - 0.5F * kWidth) / kHeight * 10, one.y[0] = 10;
        one.z[0] = (32.0F - 0.5F * kHeight) / kHeight * 10;
        one.job.view.guard_px = 2;
        one.job.largest_px = 2;
        one.job.flake_scale = 2e4F;  // whatever its size by nature
        std::fill(one.depth.begin(), one.depth.end(), 0.0F);
        const std::vector<std::uint16_t> before = one.rgba;
        one.splat({1, simd});
        for (int py = 0; py < kHeight; ++py)
            for (int px = 0; px < kWidth; ++px)
            {
                const std::size_t at = static_cast<std::size_t>(py * kWidth + px) * 4;
                const double away = std::hypot(px + 0.5 - 64, py + 0.5 - 32);
                if (std::abs(away - 2) < 0.1) continue;  // the rim itself
                const bool changed = one.rgba[at] != before[at] || one.rgba[at + 1] != before[at + 1];
                EXPECT_EQ(changed, away < 2) << px << ", " << py << " " << simd_name(simd);
            }
    }
}

TEST(TileSplatter, DrawsNothingOfFlakesThatAreNoNumbersOrOutOfSight)
{
    for (const Simd simd : available_simd())
    {
        Splash lost(4);
        lost.x[0] = std::nanf("");
        lost.z[1] = std::numeric_limits<float>::infinity();
        lost.y[2] = -5;
        lost.x[3] = 1e30F;
        const std::vector<std::uint16_t> before = lost.rgba;
        lost.splat({1, simd});
        EXPECT_EQ(lost.rgba, before) << simd_name(simd);
    }
}

}  // namespace
}  // namespace spindrift::cpu
