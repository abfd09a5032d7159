// SPDX-License-Identifier: MIT
#include "core/snow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{

using spindrift::Crystal;
using spindrift::SizeSpectrum;
using spindrift::Snow;

constexpr std::uint32_t kFlakes = 100000;

TEST(Snow, SpectraHaveThePublishedParameters)
{
    const auto gm = spindrift::size_law(SizeSpectrum::gunn_marshall, 1);
    EXPECT_NEAR(gm.intercept, 3800, 1e-9);
    EXPECT_NEAR(gm.slope, 2.55, 1e-12);
    const auto ss = spindrift::size_law(SizeSpectrum::sekhon_srivastava, 1);
    EXPECT_NEAR(ss.intercept, 2500, 1e-9);
    EXPECT_NEAR(ss.slope, 2.29, 1e-12);
    EXPECT_NEAR(spindrift::size_law(SizeSpectrum::gunn_marshall, 4).slope, 2.55 * std::pow(4, -0.48), 1e-12);
    // N = 1.09e3 R^-0.49, as the paper rounds it
    EXPECT_NEAR(spindrift::flakes_per_m3(SizeSpectrum::sekhon_srivastava, 2), 1.09e3 * std::pow(2, -0.49), 2);
}

TEST(Snow, GunnMarshallGivesTheWorkedConcentrationsWaterAndVisibility)
{
    struct Worked
    {
        double rate, flakes_per_m3, water_g_m3, visibility_km;
    };
    for (const Worked& w : {Worked{0.1, 3658, 0.025, 8.8}, {1, 1490, 0.282, 0.79}, {10, 607, 3.17, 0.07}})
    {
        EXPECT_NEAR(spindrift::flakes_per_m3(SizeSpectrum::gunn_marshall, w.rate), w.flakes_per_m3, 1);
        EXPECT_NEAR(spindrift::water_content_g_m3(SizeSpectrum::gunn_marshall, w.rate), w.water_g_m3,
                    0.005 * w.water_g_m3 + 0.0005);
        EXPECT_NEAR(3.912 / spindrift::extinction_per_km(SizeSpectrum::gunn_marshall, w.rate),
                    w.visibility_km, 0.01 * w.visibility_km + 0.004);
    }
    // 250 000 drawn flakes at 1 mm/h fill 168 m3 one to one
    EXPECT_NEAR(spindrift::weight_of_drawn(SizeSpectrum::gunn_marshall, 1, 168, 250000), 1, 0.005);
}

TEST(Snow, ARateOfZeroIsFinite)
{
    EXPECT_TRUE(std::isfinite(spindrift::flakes_per_m3(SizeSpectrum::gunn_marshall, 0)));
    Snow snow;
    snow.rate_mm_h = 0;
    EXPECT_GT(spindrift::FallSpeed(snow, 1).at<float>(5U), 0.0F);
}

double law(Crystal crystal, double d_mm)
{
    const auto fall = spindrift::fall_law(crystal);
    return fall.factor * std::pow(d_mm, fall.power);
}

TEST(FallLaw, GivesTheWorkedSpeeds)
{
    EXPECT_NEAR(law(Crystal::dendrites, 1), 0.80, 0.005);
    EXPECT_NEAR(law(Crystal::dendrites, 2), 0.89, 0.005);
    EXPECT_NEAR(law(Crystal::dendrites, 5), 1.03, 0.006);
    EXPECT_NEAR(law(Crystal::plates, 1), 0.69, 0.005);
    EXPECT_NEAR(law(Crystal::plates, 2), 0.92, 0.005);
    EXPECT_NEAR(law(Crystal::plates, 5), 1.33, 0.006);
    EXPECT_NEAR(law(Crystal::graupel, 1), 1.3, 1e-12);
    EXPECT_NEAR(law(Crystal::rimed, 2), 0.62 * std::pow(2, 0.33), 1e-12);
}

TEST(FlakeSizes, FollowTheExponentialSpectrum)
{
    Snow snow;
    snow.rate_mm_h = 2.5F;
    const double slope = spindrift::size_law(snow.spectrum, snow.rate_mm_h).slope;
    const spindrift::FlakeSizes sizes(snow, 77);
    std::vector<double> melted;
    double cubes = 0;
    for (std::uint32_t id = 0; id < kFlakes; ++id)
    {
        melted.push_back(sizes.melted_diameter_mm<float>(id));
        cubes += std::pow(melted.back(), 3);
    }
    std::sort(melted.begin(), melted.end());
    double largest = 0;
    for (std::size_t i = 0; i < melted.size(); ++i)
        largest = std::max(
            largest, std::abs(1 - std::exp(-slope * melted[i]) - (static_cast<double>(i) + 0.5) / kFlakes));
    EXPECT_LT(largest * std::sqrt(double{kFlakes}), 1.95);  // Kolmogorov-Smirnov, 0.1 % level
    // mass: the mean cube of an exponential is 6 / slope^3, its relative error sqrt(19 / n)
    EXPECT_NEAR(cubes / kFlakes * std::pow(slope, 3) / 6, 1, 4 * std::sqrt(19.0 / kFlakes));
}

TEST(FlakeSizes, FlakesHaveTheirLooseDiameterAndTheirMass)
{
    const spindrift::FlakeSizes sizes(Snow{}, 4);
    int inside = 0;
    for (std::uint32_t id = 0; id < 2000; ++id)
    {
        const double melted = sizes.melted_diameter_mm<double>(id);
        const double d = sizes.diameter_m<double>(id) * 1e3;
        EXPECT_GE(d, 0.2 - 1e-12);
        EXPECT_LE(d, 20 + 1e-12);
        EXPECT_NEAR(sizes.mass_kg<double>(id), M_PI / 6 * 1e-6 * melted * melted * melted, 1e-18);
        if (d < 0.2001 || d > 19.999) continue;
        ++inside;
        // mass over the volume of the flake is 0.17 / D g/cm3
        const double density_g_cm3 = sizes.mass_kg<double>(id) * 1e3 / (M_PI / 6 * std::pow(d * 0.1, 3));
        EXPECT_NEAR(density_g_cm3, 0.17 / d, 1e-9);
        EXPECT_NEAR(sizes.diameter_m<float>(id) * 1e3F, d, 2e-5 * d);
    }
    EXPECT_GT(inside, 1000);
}

TEST(FallSpeed, FollowsTheLawWithItsSpread)
{
    for (Crystal crystal : {Crystal::dendrites, Crystal::plates, Crystal::rimed, Crystal::graupel})
    {
        Snow snow;
        snow.crystal = crystal;
        snow.fall_speed_spread_m_s = 0.05F;
        const spindrift::FallSpeed speed(snow, 9);
        const spindrift::FlakeSizes sizes(snow, 9);
        double sum = 0, squares = 0, sizewise = 0;
        int used = 0;
        for (std::uint32_t id = 0; id < kFlakes; ++id)
        {
            const double v = speed.at<float>(id);
            EXPECT_GE(v, 0.05F);
            const double d = sizes.diameter_m<double>(id) * 1e3;
            const double off = v - law(crystal, d);
            if (law(crystal, d) < 0.05 + 3.5 * 0.05) continue;  // may meet the least speed
            ++used, sum += off, squares += off * off, sizewise += off * d;
        }
        EXPECT_NEAR(sum / used, 0, 4 * 0.05 / std::sqrt(used));
        EXPECT_NEAR(std::sqrt(squares / used), 0.05, 0.05 * 4 / std::sqrt(2.0 * used));
        EXPECT_LT(std::abs(sizewise / used), 0.01);  // size and deviation are independent
    }
}

TEST(FallSpeed, WithoutSpreadIsTheLawItself)
{
    Snow snow;
    snow.fall_speed_spread_m_s = 0;
    const spindrift::FallSpeed speed(snow, 9);
    const spindrift::FlakeSizes sizes(snow, 9);
    for (std::uint32_t id = 0; id < 5000; ++id)
    {
        const double truth = law(snow.crystal, sizes.diameter_m<double>(id) * 1e3);
        EXPECT_NEAR(speed.at<float>(id), truth, 2e-6 * truth);
        EXPECT_NEAR(speed.at<double>(id), truth, 1e-7 * truth);  // its parameters are float
    }
}

TEST(FallSpeed, OneSpeedForAllSizesReplacesTheLaw)
{
    for (const float given : {0.0F, 0.02F, 0.3F})
    {
        Snow snow;
        snow.fall_speed_m_s = given;
        snow.fall_speed_spread_m_s = 0;
        const spindrift::FallSpeed speed(snow, 9);
        for (std::uint32_t id = 0; id < 500; ++id) EXPECT_EQ(speed.at<float>(id), given);
    }
}

TEST(FallSpeed, AWideSpreadNeverStopsOrRaisesAFlake)
{
    Snow snow;
    snow.fall_speed_spread_m_s = 5;
    const spindrift::FallSpeed speed(snow, 2);
    float least = 100;
    for (std::uint32_t id = 0; id < kFlakes; ++id) least = std::min(least, speed.at<float>(id));
    EXPECT_EQ(least, 0.05F);
}

TEST(Traits, AreIndependentAndDifferBySeed)
{
    double covariance = 0;
    int same = 0;
    for (std::uint32_t id = 0; id < kFlakes; ++id)
    {
        const auto u = [&](spindrift::Trait trait)
        { return spindrift::trait_uniform<double>(spindrift::trait_hash(1, id, trait)) - 0.5; };
        covariance += u(spindrift::Trait::size) * u(spindrift::Trait::fall_speed);
        same += spindrift::trait_hash(1, id, spindrift::Trait::size) ==
                spindrift::trait_hash(2, id, spindrift::Trait::size);
    }
    EXPECT_NEAR(covariance / kFlakes, 0, 4.0 / 12 / std::sqrt(double{kFlakes}));
    EXPECT_LE(same, 2);
}

TEST(FlakeTurn, SpreadsShapesAndAnglesEvenly)
{
    int count[8] = {};
    double angle = 0, spin = 0;
    for (std::uint32_t id = 0; id < kFlakes; ++id)
    {
        const auto turn = spindrift::flake_turn(3, id, 8);
        ++count[turn.shape];
        angle += turn.angle_turns;
        spin += turn.spin_turns_per_s;
        EXPECT_LE(std::abs(turn.spin_turns_per_s), 0.5);
    }
    double chi2 = 0;
    for (int n : count) chi2 += std::pow(n - kFlakes / 8.0, 2) / (kFlakes / 8.0);
    EXPECT_LT(chi2, 24.3);  // 7 degrees of freedom, 0.1 % level
    EXPECT_NEAR(angle / kFlakes, 0.5, 4 * std::sqrt(1.0 / 12 / kFlakes));
    EXPECT_NEAR(spin / kFlakes, 0, 4 * std::sqrt(1.0 / 12 / kFlakes));
    const spindrift::FlakeTurn turn{0, 0.25, -0.125};
    EXPECT_EQ(turn.turns_at(2), 0.0);
}

}  // namespace
