// SPDX-License-Identifier: MIT
#include "core/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace
{

using spindrift::Vec3d;

TEST(Highlight, GivesBackTheLightOfALampOverheadOnce)
{
    for (const double exponent : {10.0, 60.0, 500.0})
    {
        constexpr int kSteps = 4000;
        double sum = 0;
        for (int i = 0; i < kSteps; ++i)
        {
            const double theta = (i + 0.5) * std::numbers::pi / 2 / kSteps;
            const Vec3d to_eye{std::sin(theta), 0, std::cos(theta)};
            sum += spindrift::highlight(exponent, Vec3d{0, 0, 1}, Vec3d{0, 0, 1}, to_eye) * std::cos(theta) *
                   2 * std::numbers::pi * std::sin(theta) * std::numbers::pi / 2 / kSteps;
        }
        EXPECT_NEAR(sum, 1, 1e-5) << exponent;
    }
}

TEST(Highlight, IsWhereAMirrorWouldShowTheLamp)
{
    const Vec3d normal{0, 0, 1}, to_lamp{0.6, 0, 0.8};
    const double mirrored = spindrift::highlight(200.0, normal, to_lamp, Vec3d{-0.6, 0, 0.8});
    EXPECT_GT(mirrored, 10 * spindrift::highlight(200.0, normal, to_lamp, Vec3d{0, 0, 1}));
    EXPECT_EQ(spindrift::highlight(200.0, normal, Vec3d{0.6, 0, -0.8}, Vec3d{-0.6, 0, 0.8}), 0)
        << "lit from behind";
    EXPECT_TRUE(std::isfinite(spindrift::highlight(200.0, normal, Vec3d{0, 0, 1}, Vec3d{0, 0, -1})));
}

TEST(Gloss, SharesLightBetweenMattAndMirrored)
{
    const Vec3d albedo{0.8, 0.4, 0.2};
    const auto metal = spindrift::gloss_of(albedo, 0.2, 1.0), paint = spindrift::gloss_of(albedo, 0.5, 0.0);
    EXPECT_EQ(metal.matt.x, 0);
    EXPECT_EQ(metal.mirrored.y, 0.4);
    EXPECT_NEAR(metal.exponent, 48, 1e-9);
    EXPECT_EQ(paint.matt.z, 0.2);
    EXPECT_NEAR(paint.mirrored.x, 0.04, 1e-12);
    EXPECT_LT(spindrift::gloss_of(albedo, 0.0, 0.0).exponent, 5000);
}

}  // namespace
