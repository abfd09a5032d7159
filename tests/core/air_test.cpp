// SPDX-License-Identifier: MIT
#include "core/air.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace spindrift
{
namespace
{

/// A flake's area that rises, stays and falls, so that nothing cancels.
double area_of(double depth_m)
{
    return 1e-4 * std::min(depth_m / 3, 1.0) * std::exp(-depth_m / 40);
}

struct Shade
{
    std::vector<double> area, integral;
    FlakeShade<double> view;

    Shade()
    {
        constexpr int entries = 400;
        constexpr double first = 0.1, last = 400;
        const double per_log2 = (entries - 1) / std::log2(last / first);
        double sum = 0, before = 0;
        for (int i = 0; i < entries; ++i)
        {
            const double depth = first * std::exp2(i / per_log2);
            for (int k = 0; k < 20 && i > 0; ++k)
            {
                const double step = (depth - before) / 20;
                sum += step * area_of(before + (k + 0.5) * step);
            }
            area.push_back(area_of(depth));
            integral.push_back(sum);
            before = depth;
        }
        view = {area.data(), integral.data(), entries, std::log2(first), per_log2};
    }
};

TEST(AirLayers, OpticalDepthIsTheIntegralOfTheExtinction)
{
    const AirLayers<double> air{0.003, 0.04, 0.7, 1.0};
    for (double from : {-2.0, 0.5, 1.0, 1.2, 6.0})
        for (double to : {-5.0, 0.999, 1.0, 1.2, 1.2001, 3.0, 50.0})
        {
            double sum = 0;
            const int n = 20000;
            for (int i = 0; i < n; ++i)
                sum += extinction_at(air, from + (to - from) * (i + 0.5) / n) * 80 / n;
            EXPECT_NEAR(optical_depth(air, from, to, 80.0) / sum, 1, 1e-5) << from << " " << to;
            const AirLayers<float> coarse{0.003F, 0.04F, 0.7F, 1.0F};
            EXPECT_NEAR(optical_depth(coarse, static_cast<float>(from), static_cast<float>(to), 80.0F) / sum,
                        1, 1e-4);
        }
}

TEST(AirLayers, StayFiniteFarAboveAndBelow)
{
    const AirLayers<float> air{0, 0.04F, 0.05F, 0};
    EXPECT_TRUE(std::isfinite(optical_depth(air, -1e6F, 1e6F, 2e6F)));
    EXPECT_NEAR(optical_depth(air, -10.0F, -20.0F, 10.0F), 0.4F, 1e-5F);
    EXPECT_EQ(optical_depth(air, 1e4F, 1e5F, 1e5F), 0);
}

TEST(AirPath, FogTakesOverWhatFlakesDoNotHide)
{
    const Shade shade;
    const AirLayers<double> air{0.02, 0.05, 0.5, 0};
    const FlakeVolume<double> volume{{-10, -5, 0}, {20, 30, 12}, 150, shade.view};
    const Vec3d forward{0, 1, 0};
    for (const Vec3d& eye : {Vec3d{0, 0, 2}, Vec3d{0, -40, 2}, Vec3d{60, 0, 3}, Vec3d{0, 0, 30}})
        for (const Vec3d& look :
             {Vec3d{0, 1, 0}, Vec3d{0.2, 1, -0.03}, Vec3d{-0.5, 0.7, 0.1}, Vec3d{-1, 0.3, 0}})
        {
            const Vec3d way = look * (1 / std::sqrt(dot(look, look)));
            const AirPath<double> path(air, volume, eye, way, dot(way, forward));
            double flakes = 0, all = 0, fog = 0;
            const int n = 200000;
            const double step = 150.0 / n;
            for (int i = 0; i < n; ++i)
            {
                const double t = (i + 0.5) * step;
                const Vec3d at = eye + way * t;
                const bool inside =
                    at.x > -10 && at.x < 20 && at.y > -5 && at.y < 30 && at.z > 0 && at.z < 12;
                const double depth = t * path.cosine;
                const double hides = inside && depth > 0.1 ? 150 * area_of(depth) * path.cosine : 0;
                flakes += hides * step;
                all += extinction_at(air, at.z) * step;
                fog += path.fog_at(t) * step;
            }
            EXPECT_NEAR(path.of_flakes(150), flakes, 1e-3 * flakes + 1e-6);
            EXPECT_NEAR(path.of_all(150), all, 1e-4 * all);
            EXPECT_NEAR(path.of_fog(150), fog, 1e-3 * all);
            EXPECT_NEAR(path.of_fog(150) + path.of_flakes(150), all, 1e-4 * all) << "closure";
        }
}

TEST(AirPath, WithoutFlakesAllIsFog)
{
    const AirPath<double> path({0.01, 0, 1, 0}, {}, {0, 0, 1}, {0, 1, 0}, 1);
    EXPECT_EQ(path.of_flakes(300), 0);
    EXPECT_NEAR(path.of_fog(300), 3, 1e-12);
    EXPECT_NEAR(path.fog_at(300), 0.01, 1e-15);
}

}  // namespace
}  // namespace spindrift
