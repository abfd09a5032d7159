// SPDX-License-Identifier: MIT
#include "image/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/error.h"

namespace spindrift::image
{
namespace
{

using Rgb8 = std::array<unsigned char, 3>;

Image8 even(const Rgb8& colour, int width = 24, int height = 18)
{
    Image8 image{width, height, {}};
    for (int i = 0; i < width * height; ++i) image.rgb.insert(image.rgb.end(), colour.begin(), colour.end());
    return image;
}

Image8 noise(unsigned seed)
{
    std::mt19937 random(seed);
    Image8 image = even({0, 0, 0});
    for (unsigned char& value : image.rgb) value = static_cast<unsigned char>(random());
    return image;
}

/// Textbook CIE L*a*b* of the sRGB primaries under D65, with Hunt's fading chroma.
struct Lab
{
    double l, a, b;
};
constexpr Lab kGreen{87.7347, -86.1827, 83.1793}, kBlue{32.2970, 79.1875, -107.8602};

double hyab(const Lab& p, const Lab& q)
{
    return std::abs(p.l - q.l) + std::hypot(0.01 * (p.l * p.a - q.l * q.a), 0.01 * (p.l * p.b - q.l * q.b));
}

/// The paper's equations for even pictures, where no feature differs: 0.7th power, knee at 0.4 to 0.95.
double of_difference(double off)
{
    const double most = std::pow(hyab(kGreen, kBlue), 0.7), value = std::pow(off, 0.7), limit = 0.4 * most;
    return value < limit ? 0.95 * value / limit : 0.95 + 0.05 * (value - limit) / (most - limit);
}

TEST(Flip, IsNothingBetweenEqualPictures)
{
    EXPECT_EQ(flip(noise(1), noise(1)), 0);
    EXPECT_GT(flip(noise(1), noise(2)), 0.1);
}

TEST(Flip, IsTheSameBothWays)
{
    EXPECT_EQ(flip_map(noise(1), noise(2)), flip_map(noise(2), noise(1)));
}

TEST(Flip, IsOneBetweenGreenAndBlue)
{
    for (const float value : flip_map(even({0, 255, 0}), even({0, 0, 255}))) ASSERT_NEAR(value, 1, 1e-4);
}

TEST(Flip, FollowsThePapersEquationsForEvenPictures)
{
    // From black to white L* goes from 0 to 100; grey 119 has L* = 50.03 (sRGB decoded: 0.1845).
    EXPECT_NEAR(flip(even({0, 0, 0}), even({255, 255, 255})), of_difference(100), 1e-3);
    EXPECT_NEAR(flip(even({0, 0, 0}), even({119, 119, 119})), of_difference(50.03), 1e-3);
    EXPECT_NEAR(flip(even({0, 255, 0}), even({0, 0, 0})), of_difference(hyab(kGreen, {0, 0, 0})), 1e-3);
}

TEST(Flip, DoesNotSeeWhatIsTooFineForTheEye)
{
    // Lines of one pixel and the grey of the same mean light: 188 is half of white.
    Image8 lines = even({0, 0, 0}, 40, 40);
    for (std::size_t i = 0; i < lines.rgb.size(); ++i)
        if (i / 3 % 2 == 0) lines.rgb[i] = 255;
    const Image8 grey = even({188, 188, 188}, 40, 40);
    const double near = flip(lines, grey, 20), far = flip(lines, grey, 100);
    EXPECT_LT(far, 0.5 * near);
    EXPECT_GT(near, 0.1);
}

TEST(Flip, CountsAnEdgeForMoreThanItsColours)
{
    // A step of a few levels, against the same two levels far apart in an even picture.
    Image8 step = even({120, 120, 120}, 40, 40);
    for (std::size_t i = 0; i < step.rgb.size(); ++i)
        if (i / 3 % 40 >= 20) step.rgb[i] = 140;
    const std::vector<float> map = flip_map(step, even({120, 120, 120}, 40, 40));
    const double even_part = flip(even({140, 140, 140}), even({120, 120, 120}));
    const std::size_t row = 20 * 40;
    EXPECT_NEAR(map[row + 39], even_part, 0.02) << "away from the edge";
    EXPECT_GT(map[row + 21], 1.2 * even_part) << "at the edge";
    EXPECT_NEAR(map[row], 0, 1e-3);
}

TEST(Flip, RefusesPicturesOfTwoSizes)
{
    EXPECT_THROW(flip(even({0, 0, 0}, 4, 4), even({0, 0, 0}, 4, 5)), Error);
}

}  // namespace
}  // namespace spindrift::image
