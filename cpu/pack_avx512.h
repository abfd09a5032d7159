// SPDX-License-Identifier: MIT
#pragma once

// GCC 12 takes the undefined operands of its own AVX-512 intrinsics for mistakes (GCC PR 105593).
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include "core/number.h"

// The number type of core/ for AVX-512 (F, DQ): 16 lanes. See cpu/pack.h.
// Only translation units compiled with -mavx512f -mavx512dq include it.

namespace spindrift::cpu
{

#define SPINDRIFT_FRIEND friend SPINDRIFT_HD

class Avx512Int;
class Avx512UInt;
class Avx512Real;

/// Bit i is lane i.
class Avx512Mask
{
  public:
    __mmask16 v;
    Avx512Mask() = default;
    SPINDRIFT_HD explicit Avx512Mask(__mmask16 lanes) : v(lanes) {}
    SPINDRIFT_HD explicit Avx512Mask(bool b) : v(static_cast<__mmask16>(b ? 0xFFFF : 0)) {}

    SPINDRIFT_FRIEND Avx512Mask operator&&(Avx512Mask a, Avx512Mask b)
    {
        return Avx512Mask(_kand_mask16(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Mask operator||(Avx512Mask a, Avx512Mask b)
    {
        return Avx512Mask(_kor_mask16(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Mask operator!(Avx512Mask a) { return Avx512Mask(_knot_mask16(a.v)); }
    SPINDRIFT_FRIEND std::uint32_t mask_bits(Avx512Mask a) { return a.v; }
    SPINDRIFT_FRIEND bool any(Avx512Mask a) { return a.v != 0; }
    SPINDRIFT_FRIEND bool all(Avx512Mask a) { return a.v == 0xFFFF; }
    SPINDRIFT_FRIEND bool none(Avx512Mask a) { return a.v == 0; }
};

class Avx512Int
{
  public:
    __m512i v;
    Avx512Int() = default;
    SPINDRIFT_HD explicit Avx512Int(__m512i lanes) : v(lanes) {}
    SPINDRIFT_HD Avx512Int(std::int32_t x) : v(_mm512_set1_epi32(x)) {}

    static SPINDRIFT_HD Avx512Int load(const std::int32_t* from)
    {
        return Avx512Int(_mm512_loadu_si512(reinterpret_cast<const void*>(from)));
    }
    SPINDRIFT_FRIEND void store(std::int32_t* to, Avx512Int a)
    {
        _mm512_storeu_si512(reinterpret_cast<void*>(to), a.v);
    }
    static SPINDRIFT_HD Avx512Int lane_numbers()
    {
        return Avx512Int(_mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
    }
    SPINDRIFT_FRIEND std::int32_t extract(Avx512Int a, int lane)
    {
        alignas(64) std::int32_t lanes[16];
        store(lanes, a);
        return lanes[lane];
    }
    SPINDRIFT_FRIEND void insert(Avx512Int& a, int lane, std::int32_t x)
    {
        alignas(64) std::int32_t lanes[16];
        store(lanes, a);
        lanes[lane] = x;
        a = load(lanes);
    }

    SPINDRIFT_FRIEND Avx512Int operator+(Avx512Int a, Avx512Int b)
    {
        return Avx512Int(_mm512_add_epi32(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Int operator-(Avx512Int a, Avx512Int b)
    {
        return Avx512Int(_mm512_sub_epi32(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Int operator*(Avx512Int a, Avx512Int b)
    {
        return Avx512Int(_mm512_mullo_epi32(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Int operator&(Avx512Int a, Avx512Int b)
    {
        return Avx512Int(_mm512_and_si512(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Int operator|(Avx512Int a, Avx512Int b)
    {
        return Avx512Int(_mm512_or_si512(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Int operator^(Avx512Int a, Avx512Int b)
    {
        return Avx512Int(_mm512_xor_si512(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Int operator-(Avx512Int a)
    {
        return Avx512Int(_mm512_sub_epi32(_mm512_setzero_si512(), a.v));
    }
    SPINDRIFT_FRIEND Avx512Int operator<<(Avx512Int a, int n)
    {
        return Avx512Int(_mm512_slli_epi32(a.v, static_cast<unsigned>(n)));
    }
    SPINDRIFT_FRIEND Avx512Int operator>>(Avx512Int a, int n)
    {
        return Avx512Int(_mm512_srai_epi32(a.v, static_cast<unsigned>(n)));
    }
    SPINDRIFT_FRIEND Avx512Mask operator==(Avx512Int a, Avx512Int b)
    {
        return Avx512Mask(_mm512_cmpeq_epi32_mask(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Mask operator!=(Avx512Int a, Avx512Int b) { return !(a == b); }
    SPINDRIFT_FRIEND Avx512Mask operator<(Avx512Int a, Avx512Int b)
    {
        return Avx512Mask(_mm512_cmplt_epi32_mask(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Mask operator>(Avx512Int a, Avx512Int b)
    {
        return Avx512Mask(_mm512_cmpgt_epi32_mask(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Mask operator<=(Avx512Int a, Avx512Int b) { return !(a > b); }
    SPINDRIFT_FRIEND Avx512Mask operator>=(Avx512Int a, Avx512Int b) { return !(a < b); }
    SPINDRIFT_FRIEND Avx512Int min(Avx512Int a, Avx512Int b) { return Avx512Int(_mm512_min_epi32(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx512Int max(Avx512Int a, Avx512Int b) { return Avx512Int(_mm512_max_epi32(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx512Int select(Avx512Mask m, Avx512Int yes, Avx512Int no)
    {
        return Avx512Int(_mm512_mask_mov_epi32(no.v, m.v, yes.v));
    }
};

class Avx512UInt
{
  public:
    __m512i v;
    Avx512UInt() = default;
    SPINDRIFT_HD explicit Avx512UInt(__m512i lanes) : v(lanes) {}
    SPINDRIFT_HD Avx512UInt(std::uint32_t x) : v(_mm512_set1_epi32(static_cast<int>(x))) {}

    static SPINDRIFT_HD Avx512UInt load(const std::uint32_t* from)
    {
        return Avx512UInt(_mm512_loadu_si512(reinterpret_cast<const void*>(from)));
    }
    SPINDRIFT_FRIEND void store(std::uint32_t* to, Avx512UInt a)
    {
        _mm512_storeu_si512(reinterpret_cast<void*>(to), a.v);
    }
    static SPINDRIFT_HD Avx512UInt lane_numbers()
    {
        return Avx512UInt(_mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
    }
    SPINDRIFT_FRIEND std::uint32_t extract(Avx512UInt a, int lane)
    {
        alignas(64) std::uint32_t lanes[16];
        store(lanes, a);
        return lanes[lane];
    }
    SPINDRIFT_FRIEND void insert(Avx512UInt& a, int lane, std::uint32_t x)
    {
        alignas(64) std::uint32_t lanes[16];
        store(lanes, a);
        lanes[lane] = x;
        a = load(lanes);
    }

    SPINDRIFT_FRIEND Avx512UInt operator+(Avx512UInt a, Avx512UInt b)
    {
        return Avx512UInt(_mm512_add_epi32(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512UInt operator-(Avx512UInt a, Avx512UInt b)
    {
        return Avx512UInt(_mm512_sub_epi32(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512UInt operator*(Avx512UInt a, Avx512UInt b)
    {
        return Avx512UInt(_mm512_mullo_epi32(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512UInt operator&(Avx512UInt a, Avx512UInt b)
    {
        return Avx512UInt(_mm512_and_si512(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512UInt operator|(Avx512UInt a, Avx512UInt b)
    {
        return Avx512UInt(_mm512_or_si512(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512UInt operator^(Avx512UInt a, Avx512UInt b)
    {
        return Avx512UInt(_mm512_xor_si512(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512UInt operator<<(Avx512UInt a, int n)
    {
        return Avx512UInt(_mm512_slli_epi32(a.v, static_cast<unsigned>(n)));
    }
    SPINDRIFT_FRIEND Avx512UInt operator>>(Avx512UInt a, int n)
    {
        return Avx512UInt(_mm512_srli_epi32(a.v, static_cast<unsigned>(n)));
    }
    SPINDRIFT_FRIEND Avx512Mask operator==(Avx512UInt a, Avx512UInt b)
    {
        return Avx512Mask(_mm512_cmpeq_epu32_mask(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Mask operator!=(Avx512UInt a, Avx512UInt b) { return !(a == b); }
    SPINDRIFT_FRIEND Avx512Mask operator<(Avx512UInt a, Avx512UInt b)
    {
        return Avx512Mask(_mm512_cmplt_epu32_mask(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Mask operator>(Avx512UInt a, Avx512UInt b)
    {
        return Avx512Mask(_mm512_cmpgt_epu32_mask(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Mask operator<=(Avx512UInt a, Avx512UInt b) { return !(a > b); }
    SPINDRIFT_FRIEND Avx512Mask operator>=(Avx512UInt a, Avx512UInt b) { return !(a < b); }
    SPINDRIFT_FRIEND Avx512UInt select(Avx512Mask m, Avx512UInt yes, Avx512UInt no)
    {
        return Avx512UInt(_mm512_mask_mov_epi32(no.v, m.v, yes.v));
    }
    SPINDRIFT_FRIEND Avx512Int as_int(Avx512UInt a) { return Avx512Int(a.v); }
    /// The two halves of the 64-bit products: even and odd lanes are multiplied apart.
    SPINDRIFT_FRIEND void multiply_wide(Avx512UInt a, Avx512UInt b, Avx512UInt& high, Avx512UInt& low)
    {
        const __m512i even = _mm512_mul_epu32(a.v, b.v);
        const __m512i odd = _mm512_mul_epu32(_mm512_srli_epi64(a.v, 32), _mm512_srli_epi64(b.v, 32));
        high.v = _mm512_mask_mov_epi32(_mm512_srli_epi64(even, 32), static_cast<__mmask16>(0xAAAA), odd);
        low.v = _mm512_mask_mov_epi32(even, static_cast<__mmask16>(0xAAAA), _mm512_slli_epi64(odd, 32));
    }
    SPINDRIFT_FRIEND Avx512UInt multiply_high(Avx512UInt a, Avx512UInt b)
    {
        Avx512UInt high, low;
        multiply_wide(a, b, high, low);
        return high;
    }
};

SPINDRIFT_HD Avx512UInt as_uint(Avx512Int a)
{
    return Avx512UInt(a.v);
}

SPINDRIFT_HD Avx512Int gather(const std::int32_t* base, Avx512Int index)
{
    return Avx512Int(_mm512_i32gather_epi32(index.v, base, 4));
}
SPINDRIFT_HD Avx512UInt gather(const std::uint32_t* base, Avx512Int index)
{
    return Avx512UInt(_mm512_i32gather_epi32(index.v, base, 4));
}

SPINDRIFT_HD Avx512Int gather_bytes(const std::uint8_t* base, Avx512Int index)
{
    const __m512i words = _mm512_i32gather_epi32(index.v, base, 1);
    return Avx512Int(_mm512_and_si512(words, _mm512_set1_epi32(0xFF)));
}

class Avx512Real
{
  public:
    __m512 v;
    Avx512Real() = default;
    SPINDRIFT_HD explicit Avx512Real(__m512 lanes) : v(lanes) {}
    SPINDRIFT_HD Avx512Real(float x) : v(_mm512_set1_ps(x)) {}

    static SPINDRIFT_HD Avx512Real load(const float* from) { return Avx512Real(_mm512_loadu_ps(from)); }
    SPINDRIFT_FRIEND void store(float* to, Avx512Real a) { _mm512_storeu_ps(to, a.v); }
    SPINDRIFT_FRIEND float extract(Avx512Real a, int lane)
    {
        alignas(64) float lanes[16];
        store(lanes, a);
        return lanes[lane];
    }
    SPINDRIFT_FRIEND void insert(Avx512Real& a, int lane, float x)
    {
        alignas(64) float lanes[16];
        store(lanes, a);
        lanes[lane] = x;
        a = load(lanes);
    }

    SPINDRIFT_FRIEND Avx512Real operator+(Avx512Real a, Avx512Real b)
    {
        return Avx512Real(_mm512_add_ps(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Real operator-(Avx512Real a, Avx512Real b)
    {
        return Avx512Real(_mm512_sub_ps(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Real operator*(Avx512Real a, Avx512Real b)
    {
        return Avx512Real(_mm512_mul_ps(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Real operator/(Avx512Real a, Avx512Real b)
    {
        return Avx512Real(_mm512_div_ps(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Real operator-(Avx512Real a)
    {
        return Avx512Real(_mm512_xor_ps(a.v, _mm512_set1_ps(-0.0F)));
    }
    SPINDRIFT_FRIEND Avx512Mask operator==(Avx512Real a, Avx512Real b)
    {
        return Avx512Mask(_mm512_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ));
    }
    SPINDRIFT_FRIEND Avx512Mask operator!=(Avx512Real a, Avx512Real b)
    {
        return Avx512Mask(_mm512_cmp_ps_mask(a.v, b.v, _CMP_NEQ_UQ));
    }
    SPINDRIFT_FRIEND Avx512Mask operator<(Avx512Real a, Avx512Real b)
    {
        return Avx512Mask(_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ));
    }
    SPINDRIFT_FRIEND Avx512Mask operator<=(Avx512Real a, Avx512Real b)
    {
        return Avx512Mask(_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ));
    }
    SPINDRIFT_FRIEND Avx512Mask operator>(Avx512Real a, Avx512Real b)
    {
        return Avx512Mask(_mm512_cmp_ps_mask(a.v, b.v, _CMP_GT_OQ));
    }
    SPINDRIFT_FRIEND Avx512Mask operator>=(Avx512Real a, Avx512Real b)
    {
        return Avx512Mask(_mm512_cmp_ps_mask(a.v, b.v, _CMP_GE_OQ));
    }
    SPINDRIFT_FRIEND Avx512Real select(Avx512Mask m, Avx512Real yes, Avx512Real no)
    {
        return Avx512Real(_mm512_mask_mov_ps(no.v, m.v, yes.v));
    }
    SPINDRIFT_FRIEND Avx512Real fma(Avx512Real a, Avx512Real b, Avx512Real c)
    {
        return Avx512Real(_mm512_fmadd_ps(a.v, b.v, c.v));
    }
    SPINDRIFT_FRIEND Avx512Real sqrt(Avx512Real a) { return Avx512Real(_mm512_sqrt_ps(a.v)); }
    SPINDRIFT_FRIEND Avx512Real abs(Avx512Real a)
    {
        return Avx512Real(_mm512_andnot_ps(_mm512_set1_ps(-0.0F), a.v));
    }
    SPINDRIFT_FRIEND Avx512Real copysign(Avx512Real size, Avx512Real sign)
    {
        const __m512 top = _mm512_set1_ps(-0.0F);
        return Avx512Real(_mm512_or_ps(_mm512_andnot_ps(top, size.v), _mm512_and_ps(top, sign.v)));
    }
    SPINDRIFT_FRIEND Avx512Real min(Avx512Real a, Avx512Real b)
    {
        return Avx512Real(_mm512_min_ps(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Real max(Avx512Real a, Avx512Real b)
    {
        return Avx512Real(_mm512_max_ps(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx512Real round(Avx512Real a)
    {
        return Avx512Real(_mm512_roundscale_ps(a.v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
    }
    SPINDRIFT_FRIEND Avx512Real floor(Avx512Real a)
    {
        return Avx512Real(_mm512_roundscale_ps(a.v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC));
    }
    SPINDRIFT_FRIEND Avx512Int truncate_to_int(Avx512Real a) { return Avx512Int(_mm512_cvttps_epi32(a.v)); }
    SPINDRIFT_FRIEND Avx512UInt bits(Avx512Real a) { return Avx512UInt(_mm512_castps_si512(a.v)); }
};

SPINDRIFT_HD Avx512Real from_bits(Avx512UInt b)
{
    return Avx512Real(_mm512_castsi512_ps(b.v));
}

SPINDRIFT_HD Avx512Real gather(const float* base, Avx512Int index)
{
    return Avx512Real(_mm512_i32gather_ps(index.v, base, 4));
}

#undef SPINDRIFT_FRIEND

}  // namespace spindrift::cpu

template <>
struct spindrift::NumberTraits<spindrift::cpu::Avx512Real>
{
    using Mask = cpu::Avx512Mask;
    using Int = cpu::Avx512Int;
    using UInt = cpu::Avx512UInt;
    static constexpr int width = 16;
    static constexpr bool is_double = false;
    static SPINDRIFT_HD cpu::Avx512Real from_int(Int i) { return cpu::Avx512Real(_mm512_cvtepi32_ps(i.v)); }
};
