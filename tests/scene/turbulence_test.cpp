// SPDX-License-Identifier: MIT
#include "core/turbulence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace spindrift
{
namespace
{

using Tensor = Stress<double>;

Tensor product(const StressRoot<double>& s)
{
    return {s.s11 * s.s11,
            s.s11 * s.s21,
            s.s11 * s.s31,
            s.s21 * s.s21 + s.s22 * s.s22,
            s.s21 * s.s31 + s.s22 * s.s32,
            s.s31 * s.s31 + s.s32 * s.s32 + s.s33 * s.s33};
}

void expect_near(const Tensor& a, const Tensor& b, double tolerance)
{
    EXPECT_NEAR(a.xx, b.xx, tolerance);
    EXPECT_NEAR(a.xy, b.xy, tolerance);
    EXPECT_NEAR(a.xz, b.xz, tolerance);
    EXPECT_NEAR(a.yy, b.yy, tolerance);
    EXPECT_NEAR(a.yz, b.yz, tolerance);
    EXPECT_NEAR(a.zz, b.zz, tolerance);
}

/// Q diag(l) Q^T for a rotation drawn at random.
Tensor with_eigenvalues(double l1, double l2, double l3, std::mt19937& engine)
{
    std::normal_distribution<double> normal;
    Vec3d a{normal(engine), normal(engine), normal(engine)},
        b{normal(engine), normal(engine), normal(engine)};
    a = a * (1 / std::sqrt(dot(a, a)));
    b = b - a * dot(a, b);
    b = b * (1 / std::sqrt(dot(b, b)));
    const Vec3d c = cross(a, b);
    const auto e = [&](double a1, double a2, double b1, double b2, double c1, double c2)
    { return l1 * a1 * a2 + l2 * b1 * b2 + l3 * c1 * c2; };
    return {e(a.x, a.x, b.x, b.x, c.x, c.x), e(a.x, a.y, b.x, b.y, c.x, c.y),
            e(a.x, a.z, b.x, b.z, c.x, c.z), e(a.y, a.y, b.y, b.y, c.y, c.y),
            e(a.y, a.z, b.y, b.z, c.y, c.z), e(a.z, a.z, b.z, b.z, c.z, c.z)};
}

TEST(StressRoot, MultipliesBackToARealizableStress)
{
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> share(0.1, 1);
    for (int trial = 0; trial < 200; ++trial)
    {
        const double size = std::pow(10.0, trial % 21 - 10);
        const Tensor t =
            with_eigenvalues(size * share(engine), size * share(engine), size * share(engine), engine);
        expect_near(realizable(t), t, 0);
        expect_near(product(stress_root(t)), t, 1e-13 * size);
    }
}

TEST(Realizable, MovesToTheNearestStressWithTheFloor)
{
    std::mt19937 engine(2);
    for (int trial = 0; trial < 100; ++trial)
    {
        std::mt19937 again = engine;
        const Tensor t = with_eigenvalues(3, 1, -0.7, engine);
        const Tensor expected = with_eigenvalues(3, 1, kRealizabilityFloor * 4, again);
        expect_near(realizable(t), expected, 1e-12);
        expect_near(product(stress_root(realizable(t))), expected, 1e-12);
    }
}

TEST(Realizable, EveryStressGivesFiniteNumbers)
{
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int trial = 0; trial < 5000; ++trial)
    {
        const double size = std::pow(10.0, trial % 61 - 30);
        Tensor t{size * any(engine), size * any(engine), size * any(engine),
                 size * any(engine), size * any(engine), size * any(engine)};
        if (trial % 7 == 0) t.xx = t.xy = t.xz = 0;
        if (trial % 11 == 0) t.xy = t.xz = t.yz = 0;
        if (trial % 13 == 0) t.yy = t.zz = t.yz = 0;
        const StressRoot<double> s = stress_root(realizable(t));
        for (const double v : {s.s11, s.s21, s.s22, s.s31, s.s32, s.s33}) ASSERT_TRUE(std::isfinite(v));
        const Stress<float> narrow{static_cast<float>(t.xx), static_cast<float>(t.xy),
                                   static_cast<float>(t.xz), static_cast<float>(t.yy),
                                   static_cast<float>(t.yz), static_cast<float>(t.zz)};
        const StressRoot<float> f = stress_root(realizable(narrow));
        for (const float v : {f.s11, f.s21, f.s22, f.s31, f.s32, f.s33}) ASSERT_TRUE(std::isfinite(v));
    }
}

TEST(Realizable, StressWithoutPositivePartIsCalm)
{
    expect_near(realizable(Tensor{-1, 0, 0, -2, 0, -3}), Tensor{}, 0);
    expect_near(realizable(Tensor{}), Tensor{}, 0);
    const StressRoot<double> s = stress_root(Tensor{});
    EXPECT_EQ(s.s11, 0);
}

TEST(NeutralNormalStress, TurnsWithTheWind)
{
    const double c = std::cos(0.7), s = std::sin(0.7);
    const Tensor t = neutral_normal_stress(c, s);
    EXPECT_NEAR(c * c * t.xx + 2 * c * s * t.xy + s * s * t.yy, 6.25, 1e-12);
    EXPECT_NEAR(s * s * t.xx - 2 * c * s * t.xy + c * c * t.yy, 4, 1e-12);
    EXPECT_NEAR(t.zz, 1.69, 1e-12);
}

}  // namespace
}  // namespace spindrift
