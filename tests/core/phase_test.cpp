// SPDX-License-Identifier: MIT
#include "core/phase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace
{

using spindrift::henyey_greenstein;

/// Integral over the sphere of weight(mu) times the phase function: Simpson's rule in a variable that crowds
/// the peak.
template <class Weight>
double over_sphere(double g, const Weight& weight)
{
    // mu = sign (1 - s^3 * 2), s in [0, 1]
    const double sign = g < 0 ? -1 : 1;
    const int n = 20000;
    double sum = 0;
    for (int i = 0; i <= n; ++i)
    {
        const double s = static_cast<double>(i) / n;
        const double mu = sign * (1 - 2 * s * s * s);
        const double f = weight(mu) * henyey_greenstein(g, mu) * 6 * s * s;
        sum += f * (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2);
    }
    return 2 * std::numbers::pi * sum / (3.0 * n);
}

TEST(HenyeyGreenstein, IntegratesToOneAndHasItsMeanCosine)
{
    for (double g : {-0.99, -0.9, -0.67, -0.3, -0.01, 0.0, 0.01, 0.3, 0.67, 0.77, 0.9, 0.97, 0.99})
    {
        EXPECT_NEAR(over_sphere(g, [](double) { return 1.0; }), 1, 1e-7) << g;
        EXPECT_NEAR(over_sphere(g, [](double mu) { return mu; }), g, 1e-7) << g;
    }
}

TEST(HenyeyGreenstein, FloatIsStableNearItsPeak)
{
    double worst = 0;
    for (double size : {0.0, 0.5, 0.9, 0.99, 0.999, 0.99999, 0.999999})
        for (float g : {static_cast<float>(size), -static_cast<float>(size)})
            for (double away : {0.0, 1e-7, 1e-6, 1e-5, 1e-3, 0.1, 0.5, 1.0, 1.5, 2.0})
                for (float mu : {static_cast<float>(1 - away), static_cast<float>(away - 1)})
                {
                    const double truth = henyey_greenstein<double>(g, mu);
                    worst = std::max(worst, std::abs(henyey_greenstein(g, mu) / truth - 1));
                    // against the textbook form in long double
                    const long double lg = g, lmu = mu;
                    const long double text = (1 - lg * lg) / (4 * std::numbers::pi_v<long double> *
                                                              std::pow(1 + lg * lg - 2 * lg * lmu, 1.5L));
                    EXPECT_NEAR(truth / static_cast<double>(text), 1, 1e-9) << g << " " << mu;
                }
    EXPECT_LT(worst, 1e-6);
}

TEST(HenyeyGreenstein, ALightBehindTheFlakeGivesTheForwardPeak)
{
    EXPECT_GT(henyey_greenstein(0.77, 1.0), 100 * henyey_greenstein(0.77, -1.0));
    EXPECT_LT(henyey_greenstein(-0.77, 1.0), 0.01 * henyey_greenstein(-0.77, -1.0));
    EXPECT_NEAR(henyey_greenstein(0.0, 0.3), 1 / (4 * std::numbers::pi), 1e-15);
}

}  // namespace
