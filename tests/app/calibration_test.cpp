// SPDX-License-Identifier: MIT
#include "app/calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/visibility.h"

namespace spindrift::app
{
namespace
{

TEST(Calibration, FindsTheCoverOfTheReportsTable)
{
    const Calibration c = calibrate(kReportTable, 1.4);
    EXPECT_NEAR(c.cover_s, kReportCover_s, 0.02e-6);
    EXPECT_NEAR(c.rms_grey, 7.0, 0.2);  // of its 11 rows with snow
    EXPECT_TRUE(std::isinf(c.rows.back().per_m)) << "nothing of 255 is left";
}

TEST(Calibration, RecoversAnExactCurveAndItsExtinction)
{
    std::vector<GreyReading> readings;
    for (const GreyReading& r : kReportTable) readings.push_back({r.per_s, cover_grey(r.per_s, 3e-7)});
    const Calibration c = calibrate(readings, 1.4);
    EXPECT_NEAR(c.cover_s / 3e-7, 1, 1e-5);
    EXPECT_LT(c.rms_grey, 1e-3);
    EXPECT_NEAR(c.rows.back().per_m, 1e6 * 3e-7 / 1.4, 1e-9);
}

TEST(Calibration, WritesARowForEachRateAndAPlotWithAllPoints)
{
    const Calibration c = calibrate(kReportTable, 1.4);
    const std::string csv = to_csv(c), svg = to_svg(c);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 12);
    EXPECT_NE(csv.find("100000,124.8"), std::string::npos) << csv;
    std::size_t circles = 0;
    for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1))
        ++circles;
    EXPECT_EQ(circles, 11U);
}

}  // namespace
}  // namespace spindrift::app
