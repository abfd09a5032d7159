// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/number.h"

namespace spindrift
{

// Elementary functions as polynomials with explicit fma: the same bits for float, for every SIMD pack of
// float and under CUDA, within 2 units in the last place over the whole domain
// (tests/core/math_table_test.cpp prints the table). The double versions have their own coefficients and are
// good to 1e-15. Float coefficients: Chebyshev fits with 200-bit arithmetic over the reduced range, rounded
// to float; double: Chebyshev fits, or Taylor series where these converge below 2^-56.

/// c0 + c1 x + c2 x² + …
template <class R>
SPINDRIFT_HD R polynomial(R, double c0)
{
    return number<R>(c0);
}
template <class R, class... Rest>
SPINDRIFT_HD R polynomial(R x, double c0, Rest... rest)
{
    return fma(polynomial(x, rest...), x, number<R>(c0));
}

template <class R>
SPINDRIFT_HD R infinity()
{
    return number<R>(__builtin_inf());
}
template <class R>
SPINDRIFT_HD R not_a_number()
{
    return number<R>(__builtin_nan(""));
}

/// False for NaN and infinities.
template <class R>
SPINDRIFT_HD MaskOf<R> is_finite(R x)
{
    return abs(x) < infinity<R>();
}

/// lo if x < lo or x is NaN, hi if x > hi.
template <class R>
SPINDRIFT_HD R clamp(R x, R lo, R hi)
{
    return min(max(x, lo), hi);
}

namespace detail
{

template <class R>
SPINDRIFT_HD IntOf<R> integer_to_int(R integer)
{
    const R largest = number<R>(NumberTraits<R>::is_double ? 2147483647.0 : 2147483520.0);
    const R inside = clamp(integer, number<R>(-2147483648.0), largest);
    return truncate_to_int(select(integer == integer, inside, number<R>(0)));
}

/// x = m 2^e with m in [2/3, 4/3); x > 0 and finite.
template <class R>
SPINDRIFT_HD void split_exponent(R x, R& m, R& e)
{
    using UInt = UIntOf<R>;
    const auto denormal = x < number<R>(1.17549435082228750797e-38);
    const R normal = select(denormal, x * number<R>(16777216.0), x);
    const UInt b = bits(normal);
    const IntOf<R> power = as_int(b - UInt(0x3f2aaaabU)) >> 23;
    m = from_bits(b - (as_uint(power) << 23));
    e = to_real<R>(power) - select(denormal, number<R>(24), number<R>(0));
}
SPINDRIFT_HD void split_exponent(double x, double& m, double& e)
{
    const bool denormal = x < 2.2250738585072014e-308;
    const double normal = denormal ? x * 18014398509481984.0 : x;
    const auto b = __builtin_bit_cast(std::uint64_t, normal);
    const std::int64_t power = static_cast<std::int64_t>(b - 0x3fe5555555555555U) >> 52;
    m = __builtin_bit_cast(double, b - (static_cast<std::uint64_t>(power) << 52));
    e = static_cast<double>(power) - (denormal ? 54.0 : 0.0);
}

/// x 2^n for x in [1/2, 2] and any n that exp2 meets: twice half the power, so that only the last step
/// rounds.
template <class R>
SPINDRIFT_HD R scale_by_power(R x, IntOf<R> n)
{
    using UInt = UIntOf<R>;
    const IntOf<R> half = n >> 1;
    const IntOf<R> rest = n - half;
    const R first = from_bits((as_uint(half) + UInt(127U)) << 23);
    const R second = from_bits((as_uint(rest) + UInt(127U)) << 23);
    return (x * first) * second;
}
SPINDRIFT_HD double scale_by_power(double x, std::int32_t n)
{
    const std::int64_t half = n >> 1;
    const std::int64_t rest = n - half;
    const double first = __builtin_bit_cast(double, static_cast<std::uint64_t>(half + 1023) << 52);
    const double second = __builtin_bit_cast(double, static_cast<std::uint64_t>(rest + 1023) << 52);
    return (x * first) * second;
}

/// log(1 + r) - r for r in [-1/3, 1/3).
template <class R>
SPINDRIFT_HD R log1p_tail(R r)
{
    const R r2 = r * r;
    if constexpr (NumberTraits<R>::is_double)
    {
        // log((1+s)/(1-s)), s = r/(2+r), in the form of fdlibm: r - r²/2 + s (r²/2 + series)
        const R s = r / (number<R>(2) + r);
        const R s2 = s * s;
        const R series = s2 * polynomial(s2, 2.0 / 3, 2.0 / 5, 2.0 / 7, 2.0 / 9, 2.0 / 11, 2.0 / 13, 2.0 / 15,
                                         2.0 / 17, 2.0 / 19, 2.0 / 21, 2.0 / 23, 2.0 / 25);
        const R half = number<R>(0.5) * r2;
        return fma(s, half + series, -half);
    }
    else
    {
        return r2 * polynomial(r, -0.5, 0.33333271741867065, -0.24999944865703583, 0.20007233321666718,
                               -0.16673316061496735, 0.140558123588562, -0.12288721650838852,
                               0.13748309016227722, -0.12422200292348862);
    }
}

/// exp(r) for |r| <= ln(2) / 2.
template <class R>
SPINDRIFT_HD R exp_reduced(R r)
{
    R tail;
    if constexpr (NumberTraits<R>::is_double)
        tail = polynomial(r, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720, 1.0 / 5040, 1.0 / 40320,
                          1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800);
    else
        tail = polynomial(r, 0.5, 0.1666666716337204, 0.041666463017463684, 0.00833331048488617,
                          0.001393367419950664, 0.00019891017291229218);
    return fma(r * r, tail, r) + number<R>(1);
}

/// The values that every logarithm has outside (0, inf).
template <class R>
SPINDRIFT_HD R log_ends(R x, R inside)
{
    const R zero = number<R>(0);
    R result = select(x == infinity<R>(), x, inside);
    result = select(x == zero, -infinity<R>(), result);
    return select(x >= zero, result, not_a_number<R>());
}

}  // namespace detail

/// To nearest, ties to even; outside int32 the nearest int32 that R holds (float: 2147483520); NaN gives 0.
template <class R>
SPINDRIFT_HD IntOf<R> round_to_int(R x)
{
    return detail::integer_to_int(round(x));
}

/// Downwards; outside int32 and for NaN as round_to_int.
template <class R>
SPINDRIFT_HD IntOf<R> floor_to_int(R x)
{
    return detail::integer_to_int(floor(x));
}

namespace detail
{

/// log2 of a number above 0, inf excepted.
template <class R>
SPINDRIFT_HD R log2_inside(R x)
{
    R m, e;
    detail::split_exponent(x, m, e);
    const R r = m - number<R>(1);
    const R tail = detail::log1p_tail(r);
    constexpr bool wide = NumberTraits<R>::is_double;
    const R high = number<R>(wide ? 1.4426950408889634 : 1.4426950216293335);
    const R low = number<R>(wide ? 2.0355273740931033e-17 : 1.925963033500011e-08);
    const R fraction = fma(r, high, fma(tail, high, (r + tail) * low));
    return e + fraction;
}

}  // namespace detail

/// Base 2; -inf at 0, NaN below.
template <class R>
SPINDRIFT_HD R log2(R x)
{
    return detail::log_ends(x, detail::log2_inside(x));
}

/// Natural; -inf at 0, NaN below.
template <class R>
SPINDRIFT_HD R log(R x)
{
    R m, e;
    detail::split_exponent(x, m, e);
    const R r = m - number<R>(1);
    constexpr bool wide = NumberTraits<R>::is_double;
    // e ln2_high is exact: ln2_high has few bits
    const R high = number<R>(wide ? 0.6931471803691238 : 0.693359375);
    const R low = number<R>(wide ? 1.9082149292705877e-10 : -0.00021219444170128554);
    return detail::log_ends(x, fma(e, high, r + fma(e, low, detail::log1p_tail(r))));
}

/// 2^x for x in [-126, 126]: half the work of exp2.
template <class R>
SPINDRIFT_HD R exp2_inside(R x)
{
    const R n = round(x);
    const R r = (x - n) * number<R>(0.69314718055994530942);
    const UIntOf<R> power = as_uint(truncate_to_int(n)) + UIntOf<R>(127U);
    return detail::exp_reduced(r) * from_bits(power << 23);
}
SPINDRIFT_HD double exp2_inside(double x)
{
    const double n = round(x);
    return detail::scale_by_power(detail::exp_reduced((x - n) * 0.69314718055994530942), truncate_to_int(n));
}

/// 2^x; overflows to inf, underflows through the denormals to 0; NaN stays NaN.
template <class R>
SPINDRIFT_HD R exp2(R x)
{
    constexpr bool wide = NumberTraits<R>::is_double;
    const R inside = clamp(x, number<R>(wide ? -1080 : -152), number<R>(wide ? 1025 : 129));
    const R n = round(inside);
    const R r = (inside - n) * number<R>(0.69314718055994530942);
    const R result = detail::scale_by_power(detail::exp_reduced(r), truncate_to_int(n));
    return select(x == x, result, x);
}

/// e^x; ends as exp2.
template <class R>
SPINDRIFT_HD R exp(R x)
{
    constexpr bool wide = NumberTraits<R>::is_double;
    const R inside = clamp(x, number<R>(wide ? -750 : -106), number<R>(wide ? 711 : 90));
    const R n = round(inside * number<R>(1.44269504088896340736));
    const R high = number<R>(wide ? 0.6931471803691238 : 0.693359375);
    const R low = number<R>(wide ? 1.9082149292705877e-10 : -0.00021219444170128554);
    const R r = fma(-n, low, fma(-n, high, inside));
    const R result = detail::scale_by_power(detail::exp_reduced(r), truncate_to_int(n));
    return select(x == x, result, x);
}

/// x^y for x > 0; 0 for x = 0 and y > 0. Relative error grows with |y log2 x| (float: about 1e-7 |y log2 x|).
template <class R>
SPINDRIFT_HD R pow(R x, R y)
{
    return exp2(y * log2(x));
}

/// sine and cosine of 2 pi u. The reduction to an eighth of a turn is exact for every finite u; NaN for the
/// others.
template <class R>
SPINDRIFT_HD void sincos_turns(R u, R& sine, R& cosine)
{
    const R turn = u - round(u);  // exact, in [-1/2, 1/2]; NaN for infinities
    const auto defined = turn == turn;
    const R inside = select(defined, turn, number<R>(0));
    const R quarters = round(inside * number<R>(4));
    const R r = inside - quarters * number<R>(0.25);  // exact, in [-1/8, 1/8]
    const R r2 = r * r;
    R sine_tail, cosine_tail;  // (sin(2 pi r) - 2 pi r) / r^3 and (cos(2 pi r) - 1) / r^2
    constexpr bool wide = NumberTraits<R>::is_double;
    if constexpr (wide)
    {
        sine_tail =
            polynomial(r2, -41.34170224039976, 81.60524927607506, -76.70585975306138, 42.058693944890344,
                       -15.09464257498426, 3.819952333721265, -0.7181032969030459, 0.10347980519806871);
        cosine_tail =
            polynomial(r2, -19.739208802178716, 64.9393940226683, -85.45681720669369, 60.24464137185456,
                       -26.4262567778174, 7.90353561233896, -1.714333269420992, 0.2797407860657504);
    }
    else
    {
        sine_tail =
            polynomial(r2, -41.34170150756836, 81.60523223876953, -76.70128631591797, 41.589542388916016);
        cosine_tail =
            polynomial(r2, -19.739208221435547, 64.93936920166016, -85.44882202148438, 59.42410659790039);
    }
    const R two_pi_low = number<R>(wide ? 2.4492935982947064e-16 : -1.7484555314695172e-07);
    const R s = fma(r, number<R>(6.28318530717958647693), r * fma(r2, sine_tail, two_pi_low));
    const R c = fma(r2, cosine_tail, number<R>(1));

    using Int = IntOf<R>;
    const Int q = truncate_to_int(quarters);
    const auto swapped = (q & Int(1)) == Int(1);
    const R sine_size = select(swapped, c, s);
    const R cosine_size = select(swapped, s, c);
    const auto sine_negative = (q & Int(2)) == Int(2);
    const auto cosine_negative = ((q + Int(1)) & Int(2)) == Int(2);
    sine = select(defined, select(sine_negative, -sine_size, sine_size), turn);
    cosine = select(defined, select(cosine_negative, -cosine_size, cosine_size), turn);
}

/// Angle in (-pi/2, pi/2) whose tangent is x; ±pi/2 at the infinities, NaN for NaN. |x| above 1 as pi/2 -
/// atan(1/x), above tan(pi/8) as pi/4 + atan((x - 1)/(x + 1)), the rest by its series.
template <class R>
SPINDRIFT_HD R atan(R x)
{
    const R one = number<R>(1);
    const R size = abs(x);
    const auto steep = size > one;
    const R inside = select(steep, one / size, size);
    const auto outer = inside > number<R>(0.41421356237309504880);
    const R r = select(outer, (inside - one) / (inside + one), inside);
    const R r2 = r * r;
    R tail;  // (atan(r) - r) / r
    if constexpr (NumberTraits<R>::is_double)
        tail = r2 * polynomial(r2, -1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13, -1.0 / 15,
                               1.0 / 17, -1.0 / 19, 1.0 / 21, -1.0 / 23, 1.0 / 25, -1.0 / 27, 1.0 / 29,
                               -1.0 / 31, 1.0 / 33, -1.0 / 35, 1.0 / 37, -1.0 / 39, 1.0 / 41);
    else
        tail = r2 *
               polynomial(r2, -1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13, -1.0 / 15, 1.0 / 17);
    const R small = fma(r, tail, r);
    // pi/4 is not a number of R: what it lacks
    const R low = number<R>(NumberTraits<R>::is_double ? 3.061616997868383e-17 : -2.1855694143368964e-08);
    const R quarter = number<R>(0.78539816339744830962);
    const R half = select(outer, quarter + (small + low), small);
    return copysign(select(steep, (quarter + quarter) - (half - (low + low)), half), x);
}

}  // namespace spindrift
