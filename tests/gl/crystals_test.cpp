// SPDX-License-Identifier: MIT
#include "scene/crystals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace spindrift::scene
{
namespace
{

const std::vector<CrystalMask>& masks()
{
    static const std::vector<CrystalMask> grown = grow_crystals();
    return grown;
}

TEST(Crystals, AreAtLeastEightDifferentShapes)
{
    std::set<std::string> shapes;
    for (const CrystalMask& mask : masks())
        shapes.emplace(mask.levels.front().begin(), mask.levels.front().end());
    EXPECT_GE(masks().size(), 8U);
    EXPECT_EQ(shapes.size(), masks().size());
    EXPECT_EQ(masks().size(), static_cast<std::size_t>(kCrystalShapes));
}

TEST(Crystals, AreMirroredExactlyAndSixFoldToWithinTexels)
{
    constexpr int n = kCrystalMaskPx;
    for (const CrystalMask& mask : masks())
    {
        const auto& t = mask.levels.front();
        double differs = 0;
        for (int row = 0; row < n; ++row)
            for (int column = 0; column < n; ++column)
            {
                // Cells that touch a sample point at a corner may fall either way.
                differs += std::abs(t[static_cast<std::size_t>(row * n + column)] -
                                    t[static_cast<std::size_t>((n - 1 - row) * n + column)]);
            }
        EXPECT_LT(differs / (255.0 * n * n), 2e-3);
        double turned = 0;
        double area = 0;
        for (int row = 0; row < n; ++row)
            for (int column = 0; column < n; ++column)
            {
                const double u = (column + 0.5) * 2 / n - 1;
                const double v = (row + 0.5) * 2 / n - 1;
                const double c = 0.5;
                const double s = std::sqrt(0.75);
                turned +=
                    std::abs(sample_mask(mask, u, v, 2) - sample_mask(mask, c * u + s * v, c * v - s * u, 2));
                area += sample_mask(mask, u, v, 2);
            }
        EXPECT_LT(turned / area, 0.15) << "texels are 2 % of the radius";
    }
}

TEST(Crystals, FillTheDiscAndNothingElse)
{
    constexpr int n = kCrystalMaskPx;
    for (const CrystalMask& mask : masks())
    {
        EXPECT_GT(mask.mean, 0.1);
        EXPECT_LT(mask.mean, 0.95);
        double farthest = 0;
        for (int row = 0; row < n; ++row)
            for (int column = 0; column < n; ++column)
                if (mask.levels.front()[static_cast<std::size_t>(row * n + column)] > 0)
                    farthest =
                        std::max(farthest, std::hypot((column + 0.5) * 2 / n - 1, (row + 0.5) * 2 / n - 1));
        EXPECT_GT(farthest, 0.95);
        EXPECT_LE(farthest, 1.01);
    }
}

TEST(Crystals, MipLevelsKeepTheMean)
{
    for (const CrystalMask& mask : masks())
    {
        ASSERT_EQ(mask.levels.size(), 8U);
        double mean = 0;
        for (const std::uint8_t texel : mask.levels.front()) mean += texel;
        mean /= static_cast<double>(mask.levels.front().size());
        EXPECT_NEAR(mask.levels.back().front(), mean, 4.0);
        EXPECT_NEAR(sample_mask(mask, 0, 0, 99), mask.levels.back().front() / 255.0, 1e-12);
    }
}

TEST(Crystals, AreTheSameEveryTime)
{
    const std::vector<CrystalMask> again = grow_crystals();
    for (std::size_t i = 0; i < again.size(); ++i)
    {
        EXPECT_EQ(again[i].levels, masks()[i].levels);
        EXPECT_EQ(again[i].mean, masks()[i].mean);
    }
}

}  // namespace
}  // namespace spindrift::scene
