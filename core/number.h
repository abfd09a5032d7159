// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <type_traits>

#include "core/platform.h"

namespace spindrift
{

// The primitives of a number type R of core/, here for float and double. A SIMD pack of float brings the same
// set as friends (cpu/pack_avx2.h, cpu/pack_avx512.h), which templates find by argument-dependent lookup;
// every one of them gives the bits that the float version gives in each lane. Rounding is to nearest even,
// denormals count, nothing calls libm.
//
// Masks combine with && || ! (no short circuit on packs). Int and UInt wrap modulo 2^32 on packs; on scalars
// use UInt where wrapping is meant.

/// Mask: what comparisons give. Int, UInt: 32-bit integers, as many as R has lanes. width: lanes.
template <class R>
struct NumberTraits;

template <>
struct NumberTraits<float>
{
    using Mask = bool;
    using Int = std::int32_t;
    using UInt = std::uint32_t;
    static constexpr int width = 1;
    static constexpr bool is_double = false;
    static SPINDRIFT_HD float from_int(std::int32_t i) { return static_cast<float>(i); }
};

template <>
struct NumberTraits<double>
{
    using Mask = bool;
    using Int = std::int32_t;
    using UInt = std::uint32_t;
    static constexpr int width = 1;
    static constexpr bool is_double = true;
    static SPINDRIFT_HD double from_int(std::int32_t i) { return static_cast<double>(i); }
};

template <class R>
using MaskOf = typename NumberTraits<R>::Mask;
template <class R>
using IntOf = typename NumberTraits<R>::Int;
template <class R>
using UIntOf = typename NumberTraits<R>::UInt;

/// A constant in R: rounded to float unless R is double.
template <class R>
SPINDRIFT_HD R number(double value)
{
    if constexpr (NumberTraits<R>::is_double)
        return value;
    else
        return R(static_cast<float>(value));
}

/// Signed integer to R, rounded to nearest even.
template <class R>
SPINDRIFT_HD R to_real(IntOf<R> i)
{
    return NumberTraits<R>::from_int(i);
}

// Memory. T is R, Int or UInt; addresses need no alignment beyond the element's.

template <class T, class Element>
SPINDRIFT_HD T load(const Element* from)
{
    if constexpr (std::is_arithmetic_v<T>)
        return static_cast<T>(*from);
    else
        return T::load(from);
}

SPINDRIFT_HD void store(float* to, float value)
{
    *to = value;
}
SPINDRIFT_HD void store(float* to, double value)
{
    *to = static_cast<float>(value);
}
SPINDRIFT_HD void store(std::int32_t* to, std::int32_t value)
{
    *to = value;
}
SPINDRIFT_HD void store(std::uint32_t* to, std::uint32_t value)
{
    *to = value;
}

/// base[index] lane by lane. Every lane's index must be inside the array, masked or not.
template <class Element>
SPINDRIFT_HD Element gather(const Element* base, std::int32_t index)
{
    return base[index];
}

/// base[index] of bytes. Packs read 32-bit words: 3 bytes behind the last must be readable.
SPINDRIFT_HD std::int32_t gather_bytes(const std::uint8_t* base, std::int32_t index)
{
    return base[index];
}

// Lanes.

template <class T>
requires std::is_arithmetic_v<T> SPINDRIFT_HD T extract(T value, int)
{
    return value;
}

template <class T>
requires std::is_arithmetic_v<T> SPINDRIFT_HD void insert(T& value, int, T lane)
{
    value = lane;
}

/// 0, 1, 2 … in the lanes of an Int.
template <class I>
SPINDRIFT_HD I lane_numbers()
{
    if constexpr (std::is_arithmetic_v<I>)
        return I{0};
    else
        return I::lane_numbers();
}

/// Mask of the lanes [0, n).
template <class R>
SPINDRIFT_HD MaskOf<R> first_lanes(int n)
{
    return lane_numbers<IntOf<R>>() < IntOf<R>(n);
}

SPINDRIFT_HD bool any(bool mask)
{
    return mask;
}
SPINDRIFT_HD bool all(bool mask)
{
    return mask;
}
SPINDRIFT_HD bool none(bool mask)
{
    return !mask;
}
/// Bit i is lane i.
SPINDRIFT_HD std::uint32_t mask_bits(bool mask)
{
    return mask ? 1U : 0U;
}

SPINDRIFT_HD float select(bool mask, float yes, float no)
{
    return mask ? yes : no;
}
SPINDRIFT_HD double select(bool mask, double yes, double no)
{
    return mask ? yes : no;
}
SPINDRIFT_HD std::int32_t select(bool mask, std::int32_t yes, std::int32_t no)
{
    return mask ? yes : no;
}
SPINDRIFT_HD std::uint32_t select(bool mask, std::uint32_t yes, std::uint32_t no)
{
    return mask ? yes : no;
}

// Arithmetic.

SPINDRIFT_HD float fma(float a, float b, float c)
{
    return __builtin_fmaf(a, b, c);
}
SPINDRIFT_HD double fma(double a, double b, double c)
{
    return __builtin_fma(a, b, c);
}
SPINDRIFT_HD float sqrt(float x)
{
    return __builtin_sqrtf(x);
}
SPINDRIFT_HD double sqrt(double x)
{
    return __builtin_sqrt(x);
}
SPINDRIFT_HD float abs(float x)
{
    return __builtin_fabsf(x);
}
SPINDRIFT_HD double abs(double x)
{
    return __builtin_fabs(x);
}
SPINDRIFT_HD float copysign(float size, float sign)
{
    return __builtin_copysignf(size, sign);
}
SPINDRIFT_HD double copysign(double size, double sign)
{
    return __builtin_copysign(size, sign);
}

/// min and max give b when either is NaN, and b when both are zero (as SSE's minps does; C++ and PTX differ).
SPINDRIFT_HD float min(float a, float b)
{
    return a < b ? a : b;
}
SPINDRIFT_HD float max(float a, float b)
{
    return a > b ? a : b;
}
SPINDRIFT_HD double min(double a, double b)
{
    return a < b ? a : b;
}
SPINDRIFT_HD double max(double a, double b)
{
    return a > b ? a : b;
}
SPINDRIFT_HD std::int32_t min(std::int32_t a, std::int32_t b)
{
    return a < b ? a : b;
}
SPINDRIFT_HD std::int32_t max(std::int32_t a, std::int32_t b)
{
    return a > b ? a : b;
}

/// To the nearest integer, ties to even; keeps the sign of zero, NaN and infinities.
SPINDRIFT_HD float round(float x)
{
    const float size = abs(x);  // at 2^23 and above every float is an integer
    return size < 8388608.0F ? copysign((size + 8388608.0F) - 8388608.0F, x) : x;
}
SPINDRIFT_HD double round(double x)
{
    const double size = abs(x);
    return size < 4503599627370496.0 ? copysign((size + 4503599627370496.0) - 4503599627370496.0, x) : x;
}

SPINDRIFT_HD float floor(float x)
{
    const float nearest = round(x);
    return nearest > x ? nearest - 1.0F : nearest;
}
SPINDRIFT_HD double floor(double x)
{
    const double nearest = round(x);
    return nearest > x ? nearest - 1.0 : nearest;
}

/// Towards zero. Only for values that int32 holds: round_to_int and floor_to_int (core/math.h) check.
SPINDRIFT_HD std::int32_t truncate_to_int(float x)
{
    return static_cast<std::int32_t>(x);
}
SPINDRIFT_HD std::int32_t truncate_to_int(double x)
{
    return static_cast<std::int32_t>(x);
}

// Bits.

SPINDRIFT_HD std::uint32_t bits(float x)
{
    return __builtin_bit_cast(std::uint32_t, x);
}
SPINDRIFT_HD float from_bits(std::uint32_t b)
{
    return __builtin_bit_cast(float, b);
}
SPINDRIFT_HD std::int32_t as_int(std::uint32_t u)
{
    return static_cast<std::int32_t>(u);
}
SPINDRIFT_HD std::uint32_t as_uint(std::int32_t i)
{
    return static_cast<std::uint32_t>(i);
}

/// The two halves of the 64-bit product.
SPINDRIFT_HD void multiply_wide(std::uint32_t a, std::uint32_t b, std::uint32_t& high, std::uint32_t& low)
{
    const std::uint64_t product = std::uint64_t{a} * b;
    high = static_cast<std::uint32_t>(product >> 32);
    low = static_cast<std::uint32_t>(product);
}
SPINDRIFT_HD std::uint32_t multiply_high(std::uint32_t a, std::uint32_t b)
{
    return static_cast<std::uint32_t>((std::uint64_t{a} * b) >> 32);
}

}  // namespace spindrift
