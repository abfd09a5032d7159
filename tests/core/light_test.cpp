// SPDX-License-Identifier: MIT
#include "core/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using spindrift::Lamp;
using spindrift::lamp_light;
using spindrift::LampKind;
using spindrift::Vec3d;

Lamp<double> bulb()
{
    Lamp<double> lamp;
    lamp.position_m = {0, 10, 0};
    lamp.intensity = {100, 50, 25};
    lamp.phase.g = 0.77;
    return lamp;
}

TEST(LampLight, FallsWithTheSquareOfTheDistance)
{
    const auto light = lamp_light(bulb(), Vec3d{0, 6, 0});
    EXPECT_NEAR(light.irradiance.x, 100.0 / 16, 1e-12);
    EXPECT_NEAR(light.irradiance.z, 25.0 / 16, 1e-12);
    EXPECT_NEAR(light.towards.y, 1, 1e-12);
}

TEST(LampLight, EndsAtItsRangeAndStaysFiniteAtTheLamp)
{
    Lamp<double> lamp = bulb();
    lamp.range_m = 8;
    EXPECT_EQ(lamp_light(lamp, Vec3d{0, 2, 0}).irradiance.x, 0);
    EXPECT_NEAR(lamp_light(lamp, Vec3d{0, 6, 0}).irradiance.x, 100.0 / 16 * (1 - 1.0 / 16), 1e-12);
    const auto inside = lamp_light(lamp, lamp.position_m);
    EXPECT_NEAR(inside.irradiance.x, 100 / (0.05 * 0.05), 1e-6);
    EXPECT_TRUE(std::isfinite(inside.towards.x));
}

TEST(LampLight, ASpotShinesInItsConeOnly)
{
    Lamp<double> lamp = bulb();
    lamp.kind = LampKind::spot;
    lamp.direction = {0, -1, 0};
    lamp.cos_inner = std::cos(0.3), lamp.cos_outer = std::cos(0.5);
    const auto at_angle = [&](double angle) {
        return lamp_light(lamp, Vec3d{4 * std::sin(angle), 10 - 4 * std::cos(angle), 0}).irradiance.x;
    };
    EXPECT_NEAR(at_angle(0), 100.0 / 16, 1e-12);
    EXPECT_NEAR(at_angle(0.29), 100.0 / 16, 1e-12);
    EXPECT_EQ(at_angle(0.51), 0);
    EXPECT_EQ(at_angle(3.0), 0);
    const double middle = (std::cos(0.4) - std::cos(0.5)) / (std::cos(0.3) - std::cos(0.5));
    EXPECT_NEAR(at_angle(0.4), 100.0 / 16 * middle * middle, 1e-9);
    lamp.cos_inner = lamp.cos_outer;  // no soft edge: still finite
    EXPECT_TRUE(std::isfinite(at_angle(0.5)));
}

TEST(LampLight, ADirectionalOneIsTheSameEverywhere)
{
    Lamp<double> sun = bulb();
    sun.kind = LampKind::directional;
    sun.direction = {0, 0, -1};
    const auto light = lamp_light(sun, Vec3d{1e5, -3, 7});
    EXPECT_EQ(light.irradiance.x, 100);
    EXPECT_EQ(light.towards.z, 1);
}

TEST(Scattered, ALampBehindTheFlakeOutshinesOneBeforeIt)
{
    const Lamp<double> lamp = bulb();
    const Vec3d flake{0, 5, 0};
    const auto light = lamp_light(lamp, flake);
    const double seen_against =
        spindrift::scattered(light, lamp.phase, Vec3d{0, -1, 0}).x;  // eye - flake - lamp
    const double seen_along =
        spindrift::scattered(light, lamp.phase, Vec3d{0, 1, 0}).x;  // lamp behind the eye
    EXPECT_NEAR(seen_against, 100.0 / 25 * spindrift::henyey_greenstein(0.77, 1.0), 1e-12);
    EXPECT_NEAR(seen_along, 100.0 / 25 * spindrift::henyey_greenstein(0.77, -1.0), 1e-12);
    EXPECT_GT(seen_against, 100 * seen_along);
}

TEST(Scattered, FloatFollowsDouble)
{
    Lamp<float> coarse;
    coarse.position_m = {3, 10, 4};
    coarse.intensity = {100, 50, 25};
    coarse.range_m = 40;
    coarse.phase.g = 0.5;
    Lamp<double> fine;
    fine.position_m = {3, 10, 4};
    fine.intensity = {100, 50, 25};
    fine.range_m = 40;
    fine.phase.g = 0.5;
    for (int i = 0; i < 100; ++i)
    {
        const double x = 0.3 * i - 15;
        const auto a =
            spindrift::scattered(lamp_light(coarse, {static_cast<float>(x), 2, 1}), coarse.phase, {0, -1, 0});
        const auto b =
            spindrift::scattered(lamp_light(fine, {static_cast<float>(x), 2, 1}), fine.phase, {0, -1, 0});
        EXPECT_NEAR(a.x, b.x, 2e-6 * b.x);
    }
}

TEST(Flash, IsOnForItsDutyAndShiftsWithItsPhase)
{
    using spindrift::flash_is_on;
    EXPECT_TRUE(flash_is_on(0, 2, 0.25, 0));
    EXPECT_TRUE(flash_is_on(0.124, 2, 0.25, 0));
    EXPECT_FALSE(flash_is_on(0.126, 2, 0.25, 0));
    EXPECT_TRUE(flash_is_on(0.5, 2, 0.25, 0));
    EXPECT_FALSE(flash_is_on(0, 2, 0.25, 0.5));
    EXPECT_TRUE(flash_is_on(0.25, 2, 0.25, 0.5));
    EXPECT_TRUE(flash_is_on(-0.5, 2, 0.25, 0));
    EXPECT_FALSE(flash_is_on(0.3, 2, 0, 0));
    EXPECT_TRUE(flash_is_on(0.3, 2, 1, 0));
    int on = 0;
    for (int i = 0; i < 100000; ++i) on += flash_is_on(i * 0.00137, 1.7, 0.3, 0.2) ? 1 : 0;
    EXPECT_NEAR(on / 100000.0, 0.3, 0.003);
}

}  // namespace
