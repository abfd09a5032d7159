// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gl/bloom_shape.h"
#include "reference/development.h"
#include "tests/gl/darkroom.h"
#include "tests/gl/stage.h"

namespace spindrift::gl
{
namespace
{

using scene::BloomMethod;

struct Case
{
    const char* name;
    BloomMethod method;
    double most_l1;     ///< sum of the differences from the exact Gaussian over its sum
    double most_shift;  ///< of the centre of light, px
};

void PrintTo(const Case& c, std::ostream* out)
{
    *out << c.name;
}

struct Blooming : testing::TestWithParam<Case>
{
    /// 384 px each way; 18 px of sigma are 32 px in a picture 684 px high.
    static constexpr int kSize = 384;
    static constexpr double kSigma = 18;
    Darkroom room{kSize, kSize};

    Blooming()
    {
        room.scene.bloom.method = GetParam().method;
        room.scene.bloom.sigma_px = kSigma * 720 / kSize;
        room.scene.bloom.ceiling = 6e4;
    }
};

/// Light and its first moments.
struct Sum
{
    double light = 0, x = 0, y = 0;
    explicit Sum(const image::Image& picture)
    {
        for (int row = 0; row < picture.height; ++row)
            for (int column = 0; column < picture.width; ++column)
            {
                const double value = picture.pixel(column, row)[1];
                light += value;
                x += value * column;
                y += value * row;
            }
    }
};

TEST_P(Blooming, KeepsTheLight)
{
    room.set(191, 192, 500, 1000, 4000);
    room.set(200, 180, 100, 2000, 0);
    const Sum given(room.light), spread(room.spread());
    EXPECT_NEAR(spread.light / given.light, 1, 3e-3);
    // Also as it is mixed: nothing is added to the picture.
    room.scene.bloom.weight = 0.3;
    room.scene.bloom.threshold = 0.5;
    room.scene.display.tone = ToneCurve::calibrated;
    room.scene.display.unit_cd_m2 = 1;
    room.scene.display.white_cd_m2 = 5000;
    double mixed = 0;
    const image::Image shown = room.shown();
    for (std::size_t i = 1; i < shown.rgba.size(); i += 4)
        mixed += 5000 * srgb_decoded(double{shown.rgba[i]});
    EXPECT_NEAR(mixed / given.light, 1, 3e-3);
}

TEST_P(Blooming, ComesNearTheExactGaussianWhereverTheLightIs)
{
    double worst = 0, shift = 0;
    for (const int offset : {0, 3, 5, 8})
    {
        room.fill(0);
        room.set(188 + offset, 189 + 2 * offset, 6e4F, 6e4F, 6e4F);
        const image::Image drawn = room.spread();
        const image::Image exact = reference::exact_gaussian(room.light, kSigma);
        double difference = 0;
        for (std::size_t i = 1; i < exact.rgba.size(); i += 4)
            difference += std::abs(double{drawn.rgba[i]} - double{exact.rgba[i]});
        const Sum at(drawn);
        worst = std::max(worst, difference / Sum(exact).light);
        shift = std::max(
            {shift, std::abs(at.x / at.light - 188 - offset), std::abs(at.y / at.light - 189 - 2 * offset)});
    }
    fmt::print("{}: relative L1 error {:.4f}, centre of light off by {:.3f} px\n", GetParam().name, worst,
               shift);
    EXPECT_LE(worst, GetParam().most_l1);
    EXPECT_LE(shift, GetParam().most_shift);
}

TEST_P(Blooming, ChangesNothingWhereNothingIsBright)
{
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) room.set(x, y, 0.001F * static_cast<float>(x), 0.3F, 0.45F);
    const image::Image without = room.shown();
    room.scene.bloom.weight = 0.5;
    room.scene.bloom.knee = 0.5;
    EXPECT_EQ(room.shown().rgba, without.rgba);
    EXPECT_FALSE(room.found_bright);
    // The report has no knee.
    const float light = GetParam().method == BloomMethod::legacy ? 1.2F : 0.6F;
    room.set(7, 370, light, light, light);
    room.shown();
    EXPECT_TRUE(room.found_bright) << "one pixel within the knee is enough";
}

TEST_P(Blooming, ContainsPixelsThatWentWrong)
{
    room.fill(0.2F);
    room.scene.bloom.weight = 0.2;
    room.scene.bloom.ceiling = 100;
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    room.set(100, 100, nan, nan, nan);
    room.set(250, 100, 0.2F, nan, 0.2F);
    room.set(100, 250, inf, inf, inf);
    room.set(250, 250, 65504, 65504, 65504);
    room.set(10, 10, -5, -inf, 0.2F);
    const image::Image after = room.shown();
    EXPECT_TRUE(all_finite(after));
    EXPECT_LT(after.pixel(100, 100)[0], 1e-3) << "NaN is dark";
    EXPECT_NEAR(after.pixel(100, 250)[0], 1, 1e-5);
    // Two pixels of at most 99 above the threshold, each spread over 2 pi sigma² pixels and more.
    const double most =
        0.2 * 99 / (6.2832 * kSigma * kSigma) * (GetParam().method == BloomMethod::legacy ? 2 : 1.1);
    for (int y = 0; y < kSize; y += 5)
        for (int x = 3; x < kSize; x += 5)
        {
            const double light = srgb_decoded(double{after.pixel(x, y)[0]});
            ASSERT_NEAR(light, 0.2, 2 * most + 1e-4) << x << ' ' << y;
            ASSERT_GE(light, 0.2 - 1e-4) << x << ' ' << y;
        }
}

TEST_P(Blooming, WorksAtAnySize)
{
    for (const auto& [width, height] : {std::pair{1, 1}, {33, 17}, {2, 301}, {257, 130}})
    {
        Darkroom small(width, height);
        small.scene.bloom = room.scene.bloom;
        small.scene.bloom.weight = 0.5;
        small.fill(3);
        const image::Image shown = small.shown();
        EXPECT_TRUE(all_finite(shown));
        EXPECT_NEAR(shown.pixel(width / 2, height / 2)[0], 1, 1e-5);
    }
}

// Means of 2 x 2 pixels move the centre of light by half a pixel at most. A box is no Gaussian: it is here as
// the report has it.
INSTANTIATE_TEST_SUITE_P(Methods, Blooming,
                         testing::Values(Case{"gaussian", BloomMethod::gaussian, 0.01, 0.01},
                                         Case{"reduced", BloomMethod::reduced, 0.04, 0.51},
                                         Case{"pyramid", BloomMethod::pyramid, 0.05, 0.51},
                                         Case{"dual", BloomMethod::dual, 0.10, 0.51},
                                         Case{"legacy", BloomMethod::legacy, 1.2, 0.01}),
                         [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });

TEST(BloomShape, TakesTheTapsThatItSays)
{
    scene::BloomSettings bloom;
    bloom.method = BloomMethod::gaussian;
    EXPECT_EQ(2 * bloom_shape(bloom, 720).gauss_radius + 1, 257);
    bloom.method = BloomMethod::reduced;
    EXPECT_EQ(bloom_shape(bloom, 720).scale, 8);
    EXPECT_EQ(2 * bloom_shape(bloom, 720).gauss_radius + 1, 33);
    EXPECT_LT(bloom_shape(bloom, 180).scale, 8) << "a narrow one needs finer texels";
    bloom.method = BloomMethod::pyramid;
    EXPECT_EQ(bloom_shape(bloom, 720).levels, 4);
}

}  // namespace
}  // namespace spindrift::gl
