// SPDX-License-Identifier: MIT
#include "core/airlight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace spindrift
{
namespace
{

/// The eye at 1.5 m, looking along +y, and a lamp at a distance and angle from that.
struct Sight
{
    AirLayers<double> air;
    Lamp<double> lamp;
    Vec3d eye{0, 0, 1.5}, way{0, 1, 0};

    Sight(double distance_m, double angle_deg, double visibility_m, double g)
    {
        const double angle = angle_deg * std::numbers::pi / 180;
        air.uniform_per_m = 3.912023 / visibility_m;
        lamp.position_m = eye + Vec3d{std::sin(angle), std::cos(angle), 0} * distance_m;
        lamp.intensity = {1, 1, 1};
        lamp.phase.g = g;
    }
    double glow(double to_m) const
    {
        return airlight_to(AirPath<double>(air, {}, eye, way, 1), lamp, to_m).x;
    }
    /// The integral over the way itself: 60 000 midpoints that crowd round the lamp, none of the above
    /// formulas.
    double truth(double to_m) const
    {
        const Vec3d off = lamp.position_m - eye;
        const double nearest = dot(off, way), least = std::sqrt(dot(off, off) - nearest * nearest);
        const auto crowd = [&](double t) { return std::asinh((t - nearest) / least); };
        const double first = crowd(0), last = crowd(to_m);
        const int n = 60000;
        double sum = 0;
        for (int i = 0; i < n; ++i)
        {
            const double u = first + (last - first) * (i + 0.5) / n;
            const double t = nearest + least * std::sinh(u);
            const Vec3d at = eye + way * t;
            const LampLight<double> light = lamp_light(lamp, at);
            const Vec3d back = lamp.position_m - at;
            const double r = std::sqrt(dot(back, back));
            const double depth =
                optical_depth(air, eye.z, at.z, t) + optical_depth(air, lamp.position_m.z, at.z, r);
            sum += least * std::cosh(u) * (last - first) / n * extinction_at(air, at.z) * std::exp(-depth) *
                   scattered(light, lamp.phase, way * -1.0).x;
        }
        return sum;
    }
};

TEST(Airlight, EightPointsStayWithinHalfAPercentOfQuadrature)
{
    // RENDERING: distance, angle, length of the way, visibility (2 %), g.
    struct Case
    {
        double distance_m, angle_deg, length_m, visibility_m, g;
    };
    std::printf("| lamp at, m | off by, deg | way, m | visibility, m | g | error, %% |\n");
    for (const Case& c :
         {Case{30, 10, 100, 200, 0.67}, Case{30, 2, 100, 100, 0.67}, Case{30, 2, 100, 100, -0.67},
          Case{15, 30, 60, 50, 0.67}, Case{60, 5, 600, 600, 0.77}, Case{60, 0.5, 600, 600, 0.77}})
    {
        const Sight sight(c.distance_m, c.angle_deg, c.visibility_m, c.g);
        const double truth = sight.truth(c.length_m);
        const double error = sight.glow(c.length_m) / truth - 1;
        std::printf("| %g | %g | %g | %g | %g | %+.4f |\n", c.distance_m, c.angle_deg, c.length_m,
                    c.visibility_m, c.g, 100 * error);
        EXPECT_GT(truth, 0);
        EXPECT_LT(std::abs(error), 0.005);
    }
}

TEST(Airlight, HoldsForOtherPhaseFunctionsDriftAndSurfacesBeforeTheLamp)
{
    Sight sight(30, 10, 200, 0.8);
    sight.lamp.phase = {PhaseKind::double_lobe, 0.889, -0.3, 0.1};
    EXPECT_NEAR(sight.glow(100) / sight.truth(100), 1, 0.01) << "a sharper lobe than any in the table";
    sight.lamp.phase = {PhaseKind::schlick, 0.77, 0, 0};
    EXPECT_NEAR(sight.glow(100) / sight.truth(100), 1, 0.005);
    EXPECT_NEAR(sight.glow(12) / sight.truth(12), 1, 0.005);
    sight.air = {0.004, 0.02, 0.8, 0};
    sight.lamp.position_m.z = 3.5;
    sight.way = {0.1 / std::sqrt(1.02), 1 / std::sqrt(1.02), -0.1 / std::sqrt(1.02)};
    EXPECT_NEAR(sight.glow(14) / sight.truth(14), 1, 0.005);
}

TEST(Airlight, ASpotIsIntegratedOverItsConeAlone)
{
    double worst = 0;
    for (double turn : {-1.5, -0.8, 0.0, 0.4, 1.1, 2.0, 3.1})
        for (double tilt : {-0.4, 0.0, 0.3})
        {
            Sight sight(25, 12, 150, 0.77);
            sight.lamp.kind = LampKind::spot;
            sight.lamp.direction = {std::sin(turn) * std::cos(tilt), std::cos(turn) * std::cos(tilt),
                                    std::sin(tilt)};
            sight.lamp.cos_inner = std::cos(0.25), sight.lamp.cos_outer = std::cos(0.5);
            sight.lamp.range_m = 60;
            const double truth = sight.truth(90);
            const double glow = sight.glow(90);
            // of the glow of the same lamp without a cone, lest a graze in the dark count for much
            Sight bulb = sight;
            bulb.lamp.kind = LampKind::point;
            worst = std::max(worst, std::abs(glow - truth) / std::max(truth, 0.01 * bulb.truth(90)));
        }
    std::printf("spots: worst error %.2f %%\n", 100 * worst);
    EXPECT_LT(worst, 0.02);
}

TEST(Airlight, TheLitPartIsWhereTheLampShines)
{
    Lamp<double> lamp;
    lamp.kind = LampKind::spot;
    lamp.position_m = {1, 2, 3};
    lamp.cos_inner = std::cos(0.3);
    lamp.intensity = {1, 1, 1};
    int lit = 0;
    for (int i = 0; i < 4000; ++i)
    {
        const double a = i * 0.7, b = i * 1.3, c = i * 0.37;
        lamp.direction = {std::sin(a) * std::cos(c), std::cos(a) * std::cos(c), std::sin(c)};
        lamp.cos_outer = std::cos(0.05 + 1.5 * (i % 97) / 96.0);
        lamp.range_m = i % 3 == 0 ? std::numeric_limits<double>::infinity() : 9;
        const Vec3d eye{5 * std::sin(b), -6, 2},
            way{std::sin(c) * std::cos(b), std::cos(c) * std::cos(b), std::sin(b)};
        const LitPart<double> part = lit_part(lamp, eye, way, 0.0, 40.0);
        for (int k = 0; k < 80; ++k)
        {
            const double t = 0.25 + 0.5 * k;
            const bool shines = lamp_light(lamp, eye + way * t).irradiance.x > 1e-9;
            EXPECT_TRUE(!shines || (t >= part.from - 1e-6 && t <= part.to + 1e-6)) << i << " " << t;
            lit += shines ? 1 : 0;
        }
    }
    EXPECT_GT(lit, 10000);
}

TEST(Airlight, StaysFiniteWithTheLampOnTheWay)
{
    Sight sight(20, 0, 100, 0.77);
    EXPECT_TRUE(std::isfinite(sight.glow(100)));
    EXPECT_GT(sight.glow(100), 0);
    Lamp<float> lamp;
    lamp.position_m = {0, 20, 1.5F};
    lamp.intensity = {1, 1, 1};
    lamp.phase.g = 0.77F;
    const AirPath<float> path({0.039F, 0, 1, 0}, {}, {0, 0, 1.5F}, {0, 1, 0}, 1);
    const float glow = airlight_to(path, lamp, 100.0F).x;
    EXPECT_NEAR(glow / sight.glow(100), 1, 2e-3);
}

TEST(Airlight, FloatFollowsDouble)
{
    for (double angle : {0.5, 2.0, 10.0, 60.0, 170.0})
    {
        const Sight sight(30, angle, 200, 0.77);
        Lamp<float> lamp;
        lamp.position_m = {static_cast<float>(sight.lamp.position_m.x),
                           static_cast<float>(sight.lamp.position_m.y), 1.5F};
        lamp.intensity = {1, 1, 1};
        lamp.phase.g = 0.77F;
        const AirPath<float> path({static_cast<float>(sight.air.uniform_per_m), 0, 1, 0}, {}, {0, 0, 1.5F},
                                  {0, 1, 0}, 1);
        EXPECT_NEAR(airlight_to(path, lamp, 100.0F).x / sight.glow(100), 1, 1e-4) << angle;
    }
}

}  // namespace
}  // namespace spindrift
