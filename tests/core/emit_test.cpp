// SPDX-License-Identifier: MIT
#include "core/emit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

namespace
{

using spindrift::Emitter;
using spindrift::EmitterShape;
using spindrift::StartPlace;
using spindrift::StartSampler;
using spindrift::Vec3f;

constexpr std::uint32_t kFlakes = 40000;

/// Chi-square of samples of [0, 1) in 20 equal bins: 19 degrees of freedom, 43.8 at the 0.1 % level.
class UniformBins
{
  public:
    void add(double u)
    {
        EXPECT_GE(u, -1e-6);
        EXPECT_LE(u, 1 + 1e-6);
        ++count_[std::min<std::size_t>(19, static_cast<std::size_t>(std::max(u, 0.0) * 20))];
        ++total_;
    }
    double chi2() const
    {
        double sum = 0;
        for (int n : count_) sum += std::pow(n - total_ / 20.0, 2) / (total_ / 20.0);
        return sum;
    }

  private:
    int count_[20] = {};
    int total_ = 0;
};
constexpr double kLimit = 43.8;

void expect_uniform(const Emitter& emitter, StartPlace place,
                    const std::vector<std::function<double(const Vec3f&)>>& coordinates)
{
    const StartSampler<float> sampler(emitter, 21);
    for (std::size_t c = 0; c < coordinates.size(); ++c)
    {
        UniformBins bins;
        for (std::uint32_t id = 0; id < kFlakes; ++id) bins.add(coordinates[c](sampler(id, place)));
        EXPECT_LT(bins.chi2(), kLimit) << "coordinate " << c;
    }
}

double azimuth(const Vec3f& p, const Vec3f& a)
{
    return std::atan2(double{p.y} - a.y, double{p.x} - a.x) / (2 * std::numbers::pi) + 0.5;
}

TEST(StartSampler, PutsEveryFlakeOnThePoint)
{
    Emitter e;
    e.a = {1, 2, 3};
    const Vec3f p = StartSampler<float>(e, 1)(17U);
    EXPECT_EQ(p.x, 1);
    EXPECT_EQ(p.z, 3);
}

TEST(StartSampler, IsUniformOnALine)
{
    Emitter e;
    e.shape = EmitterShape::line;
    e.a = {1, 2, 3}, e.b = {5, 0, 11};
    expect_uniform(e, StartPlace::anywhere, {[](const Vec3f& p) { return (p.x - 1) / 4; }});
    const Vec3f p = StartSampler<float>(e, 1)(5U);
    EXPECT_NEAR((p.y - 2) / -2, (p.x - 1) / 4, 1e-6);
    EXPECT_NEAR((p.z - 3) / 8, (p.x - 1) / 4, 1e-6);
}

TEST(StartSampler, IsUniformOnASphere)
{
    Emitter e;
    e.shape = EmitterShape::sphere_surface;
    e.a = {4, 5, 6};
    e.radius_m = 2;
    const StartSampler<float> sampler(e, 3);
    for (std::uint32_t id = 0; id < 1000; ++id)
    {
        const Vec3f d = sampler(id) - e.a;
        EXPECT_NEAR(std::sqrt(dot(d, d)), 2, 2e-6);
    }
    // every axis sees the same: the height of a uniform point is uniform along any of them
    expect_uniform(
        e, StartPlace::anywhere,
        {[](const Vec3f& p) { return (p.z - 4) / 4; }, [](const Vec3f& p) { return (p.x - 2) / 4; },
         [](const Vec3f& p) { return (p.y - 3) / 4; }, [&](const Vec3f& p) { return azimuth(p, e.a); }});
}

TEST(StartSampler, IsUniformInASphere)
{
    Emitter e;
    e.shape = EmitterShape::sphere_volume;
    e.a = {4, 5, 6};
    e.radius_m = 2;
    expect_uniform(e, StartPlace::anywhere,
                   {[&](const Vec3f& p) { return std::pow(std::sqrt(dot(p - e.a, p - e.a)) / 2, 3); },
                    [&](const Vec3f& p)
                    {
                        const Vec3f d = p - e.a;
                        return 0.5 * d.z / std::sqrt(dot(d, d)) + 0.5;
                    },
                    [&](const Vec3f& p) { return azimuth(p, e.a); }});
}

TEST(StartSampler, IsUniformOnAParallelogram)
{
    Emitter e;
    e.shape = EmitterShape::plane;
    e.a = {1, 75, 1}, e.b = {19, 75, 1}, e.c = {3, 75, 9};  // c leans by 2 m
    expect_uniform(e, StartPlace::anywhere,
                   {[](const Vec3f& p) { return (p.z - 1) / 8; },
                    [](const Vec3f& p) { return (p.x - 1 - 2 * (p.z - 1) / 8) / 18; }});
    EXPECT_EQ(StartSampler<float>(e, 1)(8U).y, 75);
}

TEST(StartSampler, IsUniformInABoxAndASky)
{
    Emitter box;
    box.shape = EmitterShape::box;
    box.a = {1, 2, 3}, box.b = {4, 6, 8};
    expect_uniform(
        box, StartPlace::anywhere,
        {[](const Vec3f& p) { return (p.x - 1) / 3; }, [](const Vec3f& p) { return (p.y - 2) / 4; },
         [](const Vec3f& p) { return (p.z - 3) / 5; }});
    Emitter sky;
    sky.shape = EmitterShape::sky;
    sky.a = {10, 20, 30}, sky.b = {4, 8, 2};
    expect_uniform(
        sky, StartPlace::anywhere,
        {[](const Vec3f& p) { return (p.x - 8) / 4; }, [](const Vec3f& p) { return (p.y - 16) / 8; },
         [](const Vec3f& p) { return (p.z - 29) / 2; }});
    expect_uniform(
        sky, StartPlace::top,
        {[](const Vec3f& p) { return (p.x - 8) / 4; }, [](const Vec3f& p) { return (p.y - 16) / 8; }});
    EXPECT_EQ(StartSampler<float>(sky, 1)(3U, StartPlace::top).z, 31);
    const Vec3f moved = StartSampler<float>(sky, 1, Vec3f{110, 20, 30})(3U);
    EXPECT_NEAR(moved.x, StartSampler<float>(sky, 1)(3U).x + 100, 1e-5);
}

TEST(StartSampler, DrawsAnewForEveryAttemptAndStep)
{
    Emitter e;
    e.shape = EmitterShape::line;
    e.b = {1, 0, 0};
    const StartSampler<float> sampler(e, 1);
    const float first = sampler(3U).x;
    EXPECT_NE(first, sampler(3U, StartPlace::anywhere, 1).x);
    EXPECT_NE(first, sampler(3U, StartPlace::anywhere, 0, 1).x);
    EXPECT_EQ(first, sampler(3U).x);
}

TEST(Emission, AddsUpExactlyForAnyRateAndStep)
{
    for (double rate : {0.3, 1.0, 7.0, 59.94, 12345.678, 2.5e7})
        for (double step_s : {1.0 / 60, 0.01, 0.3, 1e-4})
        {
            std::uint64_t sum = 0;
            const std::uint64_t steps = 100000;
            double least = 1e300, most = 0;
            for (std::uint64_t k = 0; k < steps; ++k)
            {
                const auto now = static_cast<double>(spindrift::emitted_in_step(rate, step_s, k));
                sum += static_cast<std::uint64_t>(now);
                least = std::min(least, now), most = std::max(most, now);
            }
            EXPECT_EQ(sum, static_cast<std::uint64_t>(rate * step_s * static_cast<double>(steps)));
            EXPECT_NEAR(least, rate * step_s, 1);
            EXPECT_NEAR(most, rate * step_s, 1);
        }
}

TEST(Emission, NeverComesFromRatesThatAreNone)
{
    for (double rate :
         {0.0, -5.0, std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()})
        EXPECT_EQ(spindrift::emitted_in_step(rate, 0.1, 12), 0U);
    EXPECT_EQ(spindrift::emitted_in_step(std::numeric_limits<double>::infinity(), 0.1, 12), 0U);
}

}  // namespace
