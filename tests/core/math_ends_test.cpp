// SPDX-License-Identifier: MIT
// What core/math.h gives for NaN, infinities, zeros, ties and numbers that do not fit.
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <limits>

#include "core/math.h"

namespace
{

template <class T>
class MathEnds : public testing::Test
{
};
using Numbers = testing::Types<float, double>;
TYPED_TEST_SUITE(MathEnds, Numbers);

TYPED_TEST(MathEnds, LogarithmsEndWhereTheyShould)
{
    using T = TypeParam;
    const T inf = std::numeric_limits<T>::infinity();
    const T nan = std::numeric_limits<T>::quiet_NaN();
    EXPECT_EQ(spindrift::log2(T(0)), -inf);
    EXPECT_EQ(spindrift::log(T(-0.0)), -inf);
    EXPECT_EQ(spindrift::log2(inf), inf);
    EXPECT_EQ(spindrift::log(inf), inf);
    for (T bad : {T(-1), -inf, nan, -std::numeric_limits<T>::denorm_min()})
    {
        EXPECT_TRUE(std::isnan(spindrift::log(bad))) << bad;
        EXPECT_TRUE(std::isnan(spindrift::log2(bad))) << bad;
    }
    EXPECT_EQ(spindrift::log(T(1)), T(0));
    EXPECT_EQ(spindrift::log2(T(8)), T(3));
    EXPECT_EQ(spindrift::log2(T(0.125)), T(-3));
}

TYPED_TEST(MathEnds, ExponentialsOverflowUnderflowAndKeepNan)
{
    using T = TypeParam;
    const T inf = std::numeric_limits<T>::infinity();
    for (T x : {T(2000), inf, std::numeric_limits<T>::max()})
    {
        EXPECT_EQ(spindrift::exp(x), inf);
        EXPECT_EQ(spindrift::exp2(x), inf);
        EXPECT_EQ(spindrift::exp(-x), T(0));
        EXPECT_EQ(spindrift::exp2(-x), T(0));
    }
    EXPECT_TRUE(std::isnan(spindrift::exp(std::numeric_limits<T>::quiet_NaN())));
    EXPECT_TRUE(std::isnan(spindrift::exp2(std::numeric_limits<T>::quiet_NaN())));
    EXPECT_EQ(spindrift::exp(T(0)), T(1));
    EXPECT_EQ(spindrift::exp2(T(-0.0)), T(1));
    EXPECT_EQ(spindrift::exp2(T(10)), T(1024));
    EXPECT_EQ(spindrift::exp2(T(std::numeric_limits<T>::min_exponent - std::numeric_limits<T>::digits)),
              std::numeric_limits<T>::denorm_min());
}

TYPED_TEST(MathEnds, TurnsOfAQuarterAreExact)
{
    using T = TypeParam;
    const T sines[] = {0, 1, 0, -1};
    for (int quarter = -9; quarter <= 9; ++quarter)
    {
        T s, c;
        spindrift::sincos_turns(T(quarter) / 4, s, c);
        EXPECT_EQ(s, sines[quarter & 3]) << quarter;
        EXPECT_EQ(c, sines[(quarter + 1) & 3]) << quarter;
    }
    T s, c;
    spindrift::sincos_turns(std::numeric_limits<T>::max(), s, c);
    EXPECT_EQ(s, T(0));
    EXPECT_EQ(c, T(1));
    for (T bad : {std::numeric_limits<T>::infinity(), std::numeric_limits<T>::quiet_NaN()})
    {
        spindrift::sincos_turns(bad, s, c);
        EXPECT_TRUE(std::isnan(s) && std::isnan(c));
    }
}

TYPED_TEST(MathEnds, RoundAndFloorAgreeWithLibm)
{
    using T = TypeParam;
    const T eps = std::numeric_limits<T>::epsilon();
    const T big = 1 / eps;
    for (T base : {T(0), T(0.3), T(0.5), T(1.5), T(2.5), T(0.5) - eps / 4, big / 2 + T(0.5), big - 1, big,
                   big * 8, std::numeric_limits<T>::max(), std::numeric_limits<T>::infinity(),
                   std::numeric_limits<T>::denorm_min()})
        for (T x : {base, -base})
        {
            EXPECT_EQ(spindrift::round(x), std::nearbyint(x)) << x;
            EXPECT_EQ(std::signbit(spindrift::round(x)), std::signbit(std::nearbyint(x))) << x;
            EXPECT_EQ(spindrift::floor(x), std::floor(x)) << x;
            EXPECT_EQ(std::signbit(spindrift::floor(x)), std::signbit(std::floor(x))) << x;
        }
    EXPECT_TRUE(std::isnan(spindrift::floor(std::numeric_limits<T>::quiet_NaN())));
}

TYPED_TEST(MathEnds, IntegersSaturateAndNanIsZero)
{
    using T = TypeParam;
    const auto top = sizeof(T) == 4 ? 2147483520 : 2147483647;
    const T inf = std::numeric_limits<T>::infinity();
    EXPECT_EQ(spindrift::round_to_int(inf), top);
    EXPECT_EQ(spindrift::round_to_int(T(3e9)), top);
    EXPECT_EQ(spindrift::floor_to_int(-inf), std::numeric_limits<int>::min());
    EXPECT_EQ(spindrift::floor_to_int(T(-3e9)), std::numeric_limits<int>::min());
    EXPECT_EQ(spindrift::round_to_int(std::numeric_limits<T>::quiet_NaN()), 0);
    EXPECT_EQ(spindrift::round_to_int(T(2.5)), 2);
    EXPECT_EQ(spindrift::round_to_int(T(-3.5)), -4);
    EXPECT_EQ(spindrift::floor_to_int(T(-0.25)), -1);
}

TYPED_TEST(MathEnds, MinAndMaxGiveTheSecondForNanAndEqualZeros)
{
    using T = TypeParam;
    const T nan = std::numeric_limits<T>::quiet_NaN();
    EXPECT_EQ(spindrift::min(nan, T(1)), T(1));
    EXPECT_TRUE(std::isnan(spindrift::min(T(1), nan)));
    EXPECT_EQ(spindrift::max(nan, T(1)), T(1));
    EXPECT_TRUE(std::isnan(spindrift::max(T(1), nan)));
    EXPECT_TRUE(std::signbit(spindrift::max(T(0), T(-0.0))));
    EXPECT_FALSE(std::signbit(spindrift::min(T(-0.0), T(0))));
    EXPECT_EQ(spindrift::clamp(nan, T(2), T(3)), T(2));
    EXPECT_FALSE(spindrift::is_finite(nan));
    EXPECT_FALSE(spindrift::is_finite(-std::numeric_limits<T>::infinity()));
    EXPECT_TRUE(spindrift::is_finite(std::numeric_limits<T>::max()));
}

}  // namespace
