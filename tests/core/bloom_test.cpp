// SPDX-License-Identifier: MIT
#include "core/bloom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/exposure.h"

namespace
{

using spindrift::Bright;
using spindrift::bright_part;
using spindrift::Vec3d;

double bright_grey(double light, const Bright<double>& bright)
{
    return bright_part(Vec3d{light, light, light}, bright).x;
}

TEST(BrightPart, IsWhatIsAboveTheThresholdAtAnyThreshold)
{
    for (const double threshold : {0.0, 0.3, 1.0, 5.0})
    {
        const Bright<double> hard{threshold, 0, 1000};
        EXPECT_EQ(bright_grey(0, hard), 0);
        EXPECT_NEAR(bright_grey(threshold + 2, hard), 2, 1e-12);
        EXPECT_EQ(bright_grey(0.99 * threshold, hard), 0);
    }
}

TEST(BrightPart, SetsInSmoothlyOverTheKnee)
{
    const Bright<double> soft{1, 0.5, 1000};
    EXPECT_EQ(bright_grey(0.5, soft), 0);
    EXPECT_GT(bright_grey(0.6, soft), 0);
    EXPECT_NEAR(bright_grey(1, soft), 0.125, 1e-12);
    EXPECT_NEAR(bright_grey(1.5, soft), 0.5, 1e-12) << "the parabola ends on the line";
    EXPECT_NEAR(bright_grey(3, soft), 2, 1e-12);
    double slope = 0;
    for (double light = 0.4; light < 2; light += 0.01)
    {
        const double now = (bright_grey(light + 1e-6, soft) - bright_grey(light, soft)) * 1e6;
        EXPECT_NEAR(now, slope, 0.011) << light;
        slope = now;
    }
}

TEST(BrightPart, KeepsHueAndStopsAtTheCeiling)
{
    const Bright<double> bright{1, 0.2, 50};
    const Vec3d amber = bright_part(Vec3d{40, 20, 4}, bright);
    EXPECT_NEAR(amber.x, 39, 1e-12);
    EXPECT_NEAR(amber.x / amber.y, 2, 1e-12);
    EXPECT_NEAR(bright_grey(6e4, bright), 49, 1e-9);
    EXPECT_NEAR(bright_grey(1e12, bright), 49, 1e-9);
}

TEST(Contained, LeavesNoNumberThatSpreads)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    const Vec3d c = spindrift::contained(Vec3d{nan, inf, -3});
    EXPECT_EQ(c.x, 0);
    EXPECT_EQ(c.y, 65504);
    EXPECT_EQ(c.z, 0);
}

TEST(GaussianWeights, SumToOneAndFallAsAGaussian)
{
    const auto weights = spindrift::gaussian_weights(128.0 / 3, 128);
    ASSERT_EQ(weights.size(), 129U);
    double sum = weights[0];
    for (std::size_t i = 1; i < weights.size(); ++i) sum += 2 * weights[i];
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(weights[128] / weights[0], std::exp(-4.5), 1e-12);
    EXPECT_NEAR(spindrift::gaussian_weights(0, 0)[0], 1, 1e-12);
}

TEST(Exposure, ShowsTheLogAverageAsGreyAndAdaptsAlikeAtAnyRate)
{
    const double mean = spindrift::log_luminance(0.5 - spindrift::kDarkest);
    EXPECT_NEAR(std::exp2(spindrift::wanted_log_exposure(mean, 0.18)) * 0.5, 0.18, 1e-12);
    EXPECT_EQ(spindrift::adapted_share(0.1, 0.0), 1) << "at once";
    const auto rest_after_a_second = [](int frames)
    { return std::pow(1 - spindrift::adapted_share(1.0 / frames, 0.7), frames); };
    EXPECT_NEAR(rest_after_a_second(10), rest_after_a_second(60), 1e-12);
    EXPECT_NEAR(rest_after_a_second(30), std::exp(-1 / 0.7), 1e-12);
}

TEST(ReportBrightPart, IsTheReportsLineWhereThatHolds)
{
    const Bright<double> bright{0.6, 0, 100};
    const Vec3d part = spindrift::report_bright_part(Vec3d{0.5, 0.7, 0.9}, bright);
    EXPECT_EQ(part.x, 0);
    EXPECT_NEAR(part.y, 0.25, 1e-12);
    EXPECT_NEAR(part.z, 0.75, 1e-12);
}

TEST(ReportBrightPart, CannotBreak)
{
    for (const double threshold : {0.0, 0.5, 0.999, 1.0, 2.0})
        for (const double light : {0.0, 0.5, 1.0, 1.5, 3.0, 65504.0})
        {
            const Vec3d grey{light, light, light};
            const double part = spindrift::report_bright_part(grey, Bright<double>{threshold, 0, 100}).x;
            EXPECT_GE(part, 0) << threshold << " " << light;
            EXPECT_LE(part, std::min(light, 100.0)) << "no more is spread than is there";
        }
}

}  // namespace
