// SPDX-License-Identifier: MIT
#include "core/visibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <iterator>

namespace spindrift
{
namespace
{

// The report's tables 3.1 (mean grey of its pictures) and 3.2 (the same, scaled so that 1M/s is 255).
struct Reading
{
    double per_s, grey;
};
constexpr Reading kTable[] = {{0, 0},           {100, 0.108},     {500, 0.845},     {1e3, 1.730},
                              {1e4, 17.182},    {25e3, 39.891},   {50e3, 77.006},   {75e3, 105.350},
                              {100e3, 124.800}, {250e3, 183.600}, {500e3, 246.175}, {1e6, 255}};

TEST(Visibility, LeavesTheContrastThatDefinesIt)
{
    for (double visibility_m : {20.0, 600.0, 4000.0})
    {
        const double mor = extinction_of_visibility(visibility_m, VisibilityContrast::five_percent);
        EXPECT_NEAR(std::exp(-mor * visibility_m), 0.05, 1e-12);
        const double two = extinction_of_visibility(visibility_m, VisibilityContrast::two_percent);
        EXPECT_NEAR(std::exp(-two * visibility_m), 0.02, 1e-12);
        EXPECT_NEAR(visibility_of_extinction(mor, VisibilityContrast::five_percent), visibility_m, 1e-9);
    }
    EXPECT_TRUE(std::isinf(visibility_of_extinction(0.0, VisibilityContrast::two_percent)));
}

TEST(Visibility, FollowsStallabrassAtOneMetreASecond)
{
    const struct
    {
        double rate_mm_h, visibility_km;
    } rows[] = {{0.5, 1.75}, {1, 1.02}, {2.5, 0.50}, {5, 0.29}, {10, 0.17}};
    for (const auto& row : rows)
    {
        const double beta = extinction_of_concentration(concentration_of_snowfall(row.rate_mm_h, 1.0));
        EXPECT_NEAR(visibility_of_extinction(beta, VisibilityContrast::two_percent), 1e3 * row.visibility_km,
                    6);
    }
}

TEST(Visibility, MeanFallSpeedIsThatOfTheSpectrum)
{
    for (Crystal crystal : {Crystal::dendrites, Crystal::plates, Crystal::rimed, Crystal::graupel})
        for (float rate : {0.1F, 1.0F, 5.0F})
        {
            Snow snow;
            snow.crystal = crystal;
            snow.rate_mm_h = rate;
            const double slope = size_law(snow.spectrum, static_cast<double>(rate)).slope;
            const FallLaw law = fall_law(crystal);
            double mass = 0, flux = 0;
            for (int i = 0; i < 20000; ++i)
            {
                const double melted = (i + 0.5) * 1e-3 * 2 / slope;
                const double m = melted * melted * melted * std::exp(-slope * melted);
                mass += m;
                flux +=
                    m * law.factor * std::pow(std::sqrt(melted * melted * melted / kFlakeDensity), law.power);
            }
            EXPECT_NEAR(mean_fall_speed(snow) / (flux / mass), 1, 1e-4);
        }
}

TEST(Visibility, SlowCrystalsHangDenserInTheAir)
{
    Snow snow;
    snow.rate_mm_h = 2.5F;
    snow.crystal = Crystal::graupel;
    const double fast = extinction_of_snowfall(snow);
    snow.crystal = Crystal::dendrites;
    EXPECT_GT(extinction_of_snowfall(snow), 1.3 * fast);
    snow.rate_mm_h = 5;
    EXPECT_GT(extinction_of_snowfall(snow), 0.01);
}

TEST(ReportFit, IsClampedAndNeverFalls)
{
    double before = 0;
    for (double x = 0; x <= 3e6; x += 1e3)
    {
        const double grey = report_grey(x);
        EXPECT_GE(grey, before);
        EXPECT_LE(grey, 255);
        EXPECT_GE(report_visibility_m(grey), kReportNearest_m);
        before = grey;
    }
    // as printed it is not 0 without snow, and above 255 from 547 000/s
    EXPECT_NEAR(report_grey(0.0), 7.0, 1e-9);
    EXPECT_EQ(report_grey(560e3), 255);
    EXPECT_LT(report_grey(540e3), 255);
    EXPECT_EQ(report_grey(-1.0), report_grey(0.0));
    EXPECT_NEAR(report_grey(100e3F), report_grey(100e3), 1e-4);
}

TEST(CoverFit, LiesNearerToTheReportsTableWithOneParameter)
{
    double fit2 = 0, cover2 = 0, worst = 0;
    for (const Reading& row : kTable)
    {
        const double fit =
            325.5 * std::exp(-2.3e-7 * row.per_s) - 318.5 * std::exp(-4.2e-6 * row.per_s) - row.grey;
        const double cover = cover_grey(row.per_s, kReportCover_s) - row.grey;
        fit2 += fit * fit, cover2 += cover * cover, worst = std::max(worst, std::abs(fit));
    }
    const double rows = std::size(kTable);
    std::printf("RMS residual: the report's fit %.2f (worst %.1f), one-parameter cover %.2f grey levels\n",
                std::sqrt(fit2 / rows), worst, std::sqrt(cover2 / rows));
    EXPECT_NEAR(std::sqrt(fit2 / rows), 9.7, 0.1);
    EXPECT_NEAR(worst, 17.9, 0.1);
    EXPECT_NEAR(std::sqrt(cover2 / rows), 6.7, 0.1);
    EXPECT_EQ(cover_grey(0.0, kReportCover_s), 0);
}

TEST(ReportTransmittance, IsClampedAndNotAnExponential)
{
    EXPECT_NEAR(report_transmittance(1.0, 60.0), 0.90, 1e-12);   // exp(-beta d) with MOR 600 m: 0.74
    EXPECT_NEAR(report_transmittance(1.0, 300.0), 0.50, 1e-12);  // 0.22
    EXPECT_EQ(report_transmittance(0.3, 300.0), 0);
    EXPECT_EQ(report_transmittance(0.3, 1e9), 0);
    EXPECT_EQ(report_transmittance(2.0, 0.0), 1);
}

}  // namespace
}  // namespace spindrift
