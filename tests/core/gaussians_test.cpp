// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/philox.h"

namespace
{

using spindrift::Gaussians;
using spindrift::RandomStream;

std::array<double, 4> draw(std::uint32_t id, std::uint32_t step)
{
    const Gaussians<float> g = spindrift::gaussians<float>(12345, id, step, RandomStream::turbulence);
    return {g.x, g.y, g.z, g.w};
}

constexpr int kIds = 1000;
constexpr int kSteps = 100;

double normal_cdf(double x)
{
    return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

TEST(Gaussians, HaveTheMomentsOfTheNormalDistribution)
{
    std::array<double, 5> moment{};
    for (std::uint32_t id = 0; id < kIds; ++id)
        for (std::uint32_t step = 0; step < kSteps; ++step)
            for (double x : draw(id, step))
                for (std::size_t k = 0; k < 5; ++k) moment[k] += std::pow(x, static_cast<double>(k));
    const double n = moment[0];
    // standard errors of raw moments: sqrt(1, 2, 15, 96 / n); four of them
    EXPECT_NEAR(moment[1] / n, 0, 4 * std::sqrt(1 / n));
    EXPECT_NEAR(moment[2] / n, 1, 4 * std::sqrt(2 / n));
    EXPECT_NEAR(moment[3] / n, 0, 4 * std::sqrt(15 / n));
    EXPECT_NEAR(moment[4] / n, 3, 4 * std::sqrt(96 / n));
}

TEST(Gaussians, PassTheKolmogorovSmirnovTest)
{
    for (std::size_t component = 0; component < 4; ++component)
    {
        std::vector<double> sample;
        for (std::uint32_t id = 0; id < kIds; ++id)
            for (std::uint32_t step = 0; step < kSteps; ++step) sample.push_back(draw(id, step)[component]);
        std::sort(sample.begin(), sample.end());
        const auto n = static_cast<double>(sample.size());
        double largest = 0;
        for (std::size_t i = 0; i < sample.size(); ++i)
        {
            const double p = normal_cdf(sample[i]);
            largest = std::max({largest, p - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - p});
        }
        EXPECT_LT(largest * std::sqrt(n), 1.95) << "component " << component;  // 0.1 % level
    }
}

TEST(Gaussians, DoNotCorrelateAcrossComponentsIdsOrSteps)
{
    double components = 0, ids = 0, steps = 0, squares = 0;
    for (std::uint32_t id = 0; id < kIds; ++id)
        for (std::uint32_t step = 0; step < kSteps; ++step)
        {
            const auto here = draw(id, step);
            components += here[0] * here[1] + here[2] * here[3];
            ids += here[0] * draw(id + 1, step)[0];
            steps += here[0] * draw(id, step + 1)[0];
            squares += (here[0] * here[0] - 1) * (here[1] * here[1] - 1);
        }
    const double n = double{kIds} * kSteps;
    EXPECT_NEAR(components / n, 0, 4 * std::sqrt(2 / n));
    EXPECT_NEAR(ids / n, 0, 4 * std::sqrt(1 / n));
    EXPECT_NEAR(steps / n, 0, 4 * std::sqrt(1 / n));
    EXPECT_NEAR(squares / n, 0, 4 * std::sqrt(4 / n));
}

TEST(Gaussians, FloatFollowsTheDoubleTruth)
{
    double largest = 0;
    for (std::uint32_t id = 0; id < 20000; ++id)
    {
        const auto words = spindrift::random_words(7, id, 3U, RandomStream::turbulence);
        const auto coarse = spindrift::gaussians<float>(words);
        const auto fine = spindrift::gaussians<double>(words);
        largest = std::max({largest, std::abs(coarse.x - fine.x), std::abs(coarse.y - fine.y),
                            std::abs(coarse.z - fine.z), std::abs(coarse.w - fine.w)});
    }
    EXPECT_LT(largest, 2e-6);
}

}  // namespace
