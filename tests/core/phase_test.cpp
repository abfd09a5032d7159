// SPDX-License-Identifier: MIT
#include "core/phase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace
{

using spindrift::henyey_greenstein;
using spindrift::Phase;
using spindrift::PhaseKind;
using spindrift::scattered_share;
using spindrift::schlick;
using spindrift::schlick_k;

/// Integral over the sphere of f(mu): Simpson's rule in a variable that crowds a peak on the side of `sign`.
template <class Function>
double sphere_integral(double sign, const Function& f)
{
    // mu = sign (1 - s^3 * 2), s in [0, 1]
    const int n = 20000;
    double sum = 0;
    for (int i = 0; i <= n; ++i)
    {
        const double s = static_cast<double>(i) / n;
        const double mu = sign * (1 - 2 * s * s * s);
        sum += f(mu) * 6 * s * s * (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2);
    }
    return 2 * std::numbers::pi * sum / (3.0 * n);
}

template <class Weight>
double over_sphere(double g, const Weight& weight)
{
    return sphere_integral(g < 0 ? -1 : 1, [&](double mu) { return weight(mu) * henyey_greenstein(g, mu); });
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

TEST(DoubleLobe, IntegratesToOneAndHasTheMeanOfItsLobes)
{
    for (double front : {0.3, 0.77, 0.889, 0.95})
        for (double back : {-0.7, -0.3, 0.0})
            for (double share : {0.0, 0.1, 0.4})
            {
                const Phase<double> phase{PhaseKind::double_lobe, front, back, share};
                const auto p = [&](double mu) { return scattered_share(phase, mu); };
                EXPECT_NEAR(sphere_integral(1, p), 1, 1e-7);
                EXPECT_NEAR(sphere_integral(1, [&](double mu) { return mu * p(mu); }),
                            (1 - share) * front + share * back, 1e-7);
            }
}

TEST(Schlick, IntegratesToOneUpToWhereItIsRefused)
{
    for (double size : {0.0, 0.3, 0.67, 0.77, 0.85, spindrift::kLargestSchlickG})
        for (double g : {size, -size})
        {
            const double k = schlick_k(g);
            EXPECT_LT(std::abs(k), 1);
            EXPECT_NEAR(sphere_integral(g < 0 ? -1 : 1, [&](double mu) { return schlick(k, mu); }), 1, 1e-5)
                << g;
            EXPECT_TRUE(std::isfinite(schlick(static_cast<float>(k), g < 0 ? -1.0F : 1.0F)));
        }
    // Beyond g = 0.9381 the pole lies at a cosine that exists, and the function is negative.
    EXPECT_GT(schlick_k(0.94), 1);
    EXPECT_LT(schlick(schlick_k(0.96), 0.5), 0);
}

TEST(Schlick, ErrsAsItsTableSays)
{
    // docs/drawing.md "Phase functions": mean cosine; p over HG at 0, 90 and 180 degrees; half the integral
    // of the difference's size.
    struct Row
    {
        double g, mean, at_0, at_90, at_180, apart;
    };
    std::printf("| g | mean cosine | p/HG at 0 | 90 | 180 degrees | L1 |\n");
    for (const Row& row :
         {Row{0.50, 0.532, 0.97, 0.93, 0.78, 0.057}, Row{0.67, 0.726, 0.96, 0.75, 0.57, 0.108},
          Row{0.77, 0.840, 1.01, 0.55, 0.40, 0.16}, Row{0.85, 0.925, 1.19, 0.33, 0.23, 0.25},
          Row{0.89, 0.963, 1.55, 0.19, 0.13, 0.37}})
    {
        const double k = schlick_k(row.g);
        const auto ratio = [&](double mu) { return schlick(k, mu) / henyey_greenstein(row.g, mu); };
        const double mean = sphere_integral(1, [&](double mu) { return mu * schlick(k, mu); });
        const double apart = sphere_integral(
            1, [&](double mu) { return std::abs(schlick(k, mu) - henyey_greenstein(row.g, mu)); });
        std::printf("| %.2f | %.3f | %.2f | %.2f | %.2f | %.1f %% |\n", row.g, mean, ratio(1), ratio(0),
                    ratio(-1), 100 * apart);
        EXPECT_NEAR(mean, row.mean, 1e-3);
        EXPECT_NEAR(ratio(1), row.at_0, 6e-3);
        EXPECT_NEAR(ratio(0), row.at_90, 6e-3);
        EXPECT_NEAR(ratio(-1), row.at_180, 6e-3);
        EXPECT_NEAR(apart, row.apart, 6e-3);
    }
}

}  // namespace
