// SPDX-License-Identifier: MIT
#pragma once

#include <immintrin.h>

#include "core/number.h"

// The number type of core/ for AVX2 with FMA: 8 lanes. See cpu/pack.h.
// Only translation units compiled with -mavx2 -mfma include it.

namespace spindrift::cpu
{

#define SPINDRIFT_FRIEND friend SPINDRIFT_HD

class Avx2Int;
class Avx2UInt;
class Avx2Real;

/// All bits of a lane set: true.
class Avx2Mask
{
  public:
    __m256 v;
    Avx2Mask() = default;
    SPINDRIFT_HD explicit Avx2Mask(__m256 lanes) : v(lanes) {}
    SPINDRIFT_HD explicit Avx2Mask(__m256i lanes) : v(_mm256_castsi256_ps(lanes)) {}
    SPINDRIFT_HD explicit Avx2Mask(bool b) : v(_mm256_castsi256_ps(_mm256_set1_epi32(b ? -1 : 0))) {}

    SPINDRIFT_FRIEND Avx2Mask operator&&(Avx2Mask a, Avx2Mask b) { return Avx2Mask(_mm256_and_ps(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Mask operator||(Avx2Mask a, Avx2Mask b) { return Avx2Mask(_mm256_or_ps(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Mask operator!(Avx2Mask a)
    {
        return Avx2Mask(_mm256_xor_ps(a.v, _mm256_castsi256_ps(_mm256_set1_epi32(-1))));
    }
    SPINDRIFT_FRIEND std::uint32_t mask_bits(Avx2Mask a)
    {
        return static_cast<std::uint32_t>(_mm256_movemask_ps(a.v));
    }
    SPINDRIFT_FRIEND bool any(Avx2Mask a) { return _mm256_movemask_ps(a.v) != 0; }
    SPINDRIFT_FRIEND bool all(Avx2Mask a) { return _mm256_movemask_ps(a.v) == 0xFF; }
    SPINDRIFT_FRIEND bool none(Avx2Mask a) { return _mm256_movemask_ps(a.v) == 0; }
};

class Avx2Int
{
  public:
    __m256i v;
    Avx2Int() = default;
    SPINDRIFT_HD explicit Avx2Int(__m256i lanes) : v(lanes) {}
    SPINDRIFT_HD Avx2Int(std::int32_t x) : v(_mm256_set1_epi32(x)) {}

    static SPINDRIFT_HD Avx2Int load(const std::int32_t* from)
    {
        return Avx2Int(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
    }
    SPINDRIFT_FRIEND void store(std::int32_t* to, Avx2Int a)
    {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a.v);
    }
    static SPINDRIFT_HD Avx2Int lane_numbers() { return Avx2Int(_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)); }
    SPINDRIFT_FRIEND std::int32_t extract(Avx2Int a, int lane)
    {
        alignas(32) std::int32_t lanes[8];
        store(lanes, a);
        return lanes[lane];
    }
    SPINDRIFT_FRIEND void insert(Avx2Int& a, int lane, std::int32_t x)
    {
        alignas(32) std::int32_t lanes[8];
        store(lanes, a);
        lanes[lane] = x;
        a = load(lanes);
    }

    SPINDRIFT_FRIEND Avx2Int operator+(Avx2Int a, Avx2Int b) { return Avx2Int(_mm256_add_epi32(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Int operator-(Avx2Int a, Avx2Int b) { return Avx2Int(_mm256_sub_epi32(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Int operator*(Avx2Int a, Avx2Int b) { return Avx2Int(_mm256_mullo_epi32(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Int operator&(Avx2Int a, Avx2Int b) { return Avx2Int(_mm256_and_si256(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Int operator|(Avx2Int a, Avx2Int b) { return Avx2Int(_mm256_or_si256(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Int operator^(Avx2Int a, Avx2Int b) { return Avx2Int(_mm256_xor_si256(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Int operator-(Avx2Int a)
    {
        return Avx2Int(_mm256_sub_epi32(_mm256_setzero_si256(), a.v));
    }
    SPINDRIFT_FRIEND Avx2Int operator<<(Avx2Int a, int n) { return Avx2Int(_mm256_slli_epi32(a.v, n)); }
    SPINDRIFT_FRIEND Avx2Int operator>>(Avx2Int a, int n) { return Avx2Int(_mm256_srai_epi32(a.v, n)); }
    SPINDRIFT_FRIEND Avx2Mask operator==(Avx2Int a, Avx2Int b)
    {
        return Avx2Mask(_mm256_cmpeq_epi32(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx2Mask operator!=(Avx2Int a, Avx2Int b) { return !(a == b); }
    SPINDRIFT_FRIEND Avx2Mask operator<(Avx2Int a, Avx2Int b)
    {
        return Avx2Mask(_mm256_cmpgt_epi32(b.v, a.v));
    }
    SPINDRIFT_FRIEND Avx2Mask operator>(Avx2Int a, Avx2Int b)
    {
        return Avx2Mask(_mm256_cmpgt_epi32(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx2Mask operator<=(Avx2Int a, Avx2Int b) { return !(a > b); }
    SPINDRIFT_FRIEND Avx2Mask operator>=(Avx2Int a, Avx2Int b) { return !(a < b); }
    SPINDRIFT_FRIEND Avx2Int min(Avx2Int a, Avx2Int b) { return Avx2Int(_mm256_min_epi32(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Int max(Avx2Int a, Avx2Int b) { return Avx2Int(_mm256_max_epi32(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Int select(Avx2Mask m, Avx2Int yes, Avx2Int no)
    {
        return Avx2Int(_mm256_castps_si256(
            _mm256_blendv_ps(_mm256_castsi256_ps(no.v), _mm256_castsi256_ps(yes.v), m.v)));
    }
};

class Avx2UInt
{
  public:
    __m256i v;
    Avx2UInt() = default;
    SPINDRIFT_HD explicit Avx2UInt(__m256i lanes) : v(lanes) {}
    SPINDRIFT_HD Avx2UInt(std::uint32_t x) : v(_mm256_set1_epi32(static_cast<int>(x))) {}

    static SPINDRIFT_HD Avx2UInt load(const std::uint32_t* from)
    {
        return Avx2UInt(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
    }
    SPINDRIFT_FRIEND void store(std::uint32_t* to, Avx2UInt a)
    {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a.v);
    }
    static SPINDRIFT_HD Avx2UInt lane_numbers()
    {
        return Avx2UInt(_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    }
    SPINDRIFT_FRIEND std::uint32_t extract(Avx2UInt a, int lane)
    {
        alignas(32) std::uint32_t lanes[8];
        store(lanes, a);
        return lanes[lane];
    }
    SPINDRIFT_FRIEND void insert(Avx2UInt& a, int lane, std::uint32_t x)
    {
        alignas(32) std::uint32_t lanes[8];
        store(lanes, a);
        lanes[lane] = x;
        a = load(lanes);
    }

    SPINDRIFT_FRIEND Avx2UInt operator+(Avx2UInt a, Avx2UInt b)
    {
        return Avx2UInt(_mm256_add_epi32(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx2UInt operator-(Avx2UInt a, Avx2UInt b)
    {
        return Avx2UInt(_mm256_sub_epi32(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx2UInt operator*(Avx2UInt a, Avx2UInt b)
    {
        return Avx2UInt(_mm256_mullo_epi32(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx2UInt operator&(Avx2UInt a, Avx2UInt b)
    {
        return Avx2UInt(_mm256_and_si256(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx2UInt operator|(Avx2UInt a, Avx2UInt b)
    {
        return Avx2UInt(_mm256_or_si256(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx2UInt operator^(Avx2UInt a, Avx2UInt b)
    {
        return Avx2UInt(_mm256_xor_si256(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx2UInt operator<<(Avx2UInt a, int n) { return Avx2UInt(_mm256_slli_epi32(a.v, n)); }
    SPINDRIFT_FRIEND Avx2UInt operator>>(Avx2UInt a, int n) { return Avx2UInt(_mm256_srli_epi32(a.v, n)); }
    SPINDRIFT_FRIEND Avx2Mask operator==(Avx2UInt a, Avx2UInt b)
    {
        return Avx2Mask(_mm256_cmpeq_epi32(a.v, b.v));
    }
    SPINDRIFT_FRIEND Avx2Mask operator!=(Avx2UInt a, Avx2UInt b) { return !(a == b); }
    SPINDRIFT_FRIEND Avx2Mask operator<(Avx2UInt a, Avx2UInt b)
    {
        const __m256i top =
            _mm256_set1_epi32(INT32_MIN);  // unsigned order is signed order with the top bit turned
        return Avx2Mask(_mm256_cmpgt_epi32(_mm256_xor_si256(b.v, top), _mm256_xor_si256(a.v, top)));
    }
    SPINDRIFT_FRIEND Avx2Mask operator>(Avx2UInt a, Avx2UInt b) { return b < a; }
    SPINDRIFT_FRIEND Avx2Mask operator<=(Avx2UInt a, Avx2UInt b) { return !(a > b); }
    SPINDRIFT_FRIEND Avx2Mask operator>=(Avx2UInt a, Avx2UInt b) { return !(a < b); }
    SPINDRIFT_FRIEND Avx2UInt select(Avx2Mask m, Avx2UInt yes, Avx2UInt no)
    {
        return Avx2UInt(_mm256_castps_si256(
            _mm256_blendv_ps(_mm256_castsi256_ps(no.v), _mm256_castsi256_ps(yes.v), m.v)));
    }
    SPINDRIFT_FRIEND Avx2Int as_int(Avx2UInt a) { return Avx2Int(a.v); }
    /// The two halves of the 64-bit products: even and odd lanes are multiplied apart.
    SPINDRIFT_FRIEND void multiply_wide(Avx2UInt a, Avx2UInt b, Avx2UInt& high, Avx2UInt& low)
    {
        const __m256i even = _mm256_mul_epu32(a.v, b.v);
        const __m256i odd = _mm256_mul_epu32(_mm256_srli_epi64(a.v, 32), _mm256_srli_epi64(b.v, 32));
        high.v = _mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xAA);
        low.v = _mm256_blend_epi32(even, _mm256_slli_epi64(odd, 32), 0xAA);
    }
    SPINDRIFT_FRIEND Avx2UInt multiply_high(Avx2UInt a, Avx2UInt b)
    {
        Avx2UInt high, low;
        multiply_wide(a, b, high, low);
        return high;
    }
};

SPINDRIFT_HD Avx2UInt as_uint(Avx2Int a)
{
    return Avx2UInt(a.v);
}

SPINDRIFT_HD Avx2Int gather(const std::int32_t* base, Avx2Int index)
{
    return Avx2Int(_mm256_i32gather_epi32(reinterpret_cast<const int*>(base), index.v, 4));
}
SPINDRIFT_HD Avx2UInt gather(const std::uint32_t* base, Avx2Int index)
{
    return Avx2UInt(_mm256_i32gather_epi32(reinterpret_cast<const int*>(base), index.v, 4));
}

SPINDRIFT_HD Avx2Int gather_bytes(const std::uint8_t* base, Avx2Int index)
{
    const __m256i words = _mm256_i32gather_epi32(reinterpret_cast<const int*>(base), index.v, 1);
    return Avx2Int(_mm256_and_si256(words, _mm256_set1_epi32(0xFF)));
}

class Avx2Real
{
  public:
    __m256 v;
    Avx2Real() = default;
    SPINDRIFT_HD explicit Avx2Real(__m256 lanes) : v(lanes) {}
    SPINDRIFT_HD Avx2Real(float x) : v(_mm256_set1_ps(x)) {}

    static SPINDRIFT_HD Avx2Real load(const float* from) { return Avx2Real(_mm256_loadu_ps(from)); }
    SPINDRIFT_FRIEND void store(float* to, Avx2Real a) { _mm256_storeu_ps(to, a.v); }
    SPINDRIFT_FRIEND float extract(Avx2Real a, int lane)
    {
        alignas(32) float lanes[8];
        store(lanes, a);
        return lanes[lane];
    }
    SPINDRIFT_FRIEND void insert(Avx2Real& a, int lane, float x)
    {
        alignas(32) float lanes[8];
        store(lanes, a);
        lanes[lane] = x;
        a = load(lanes);
    }

    SPINDRIFT_FRIEND Avx2Real operator+(Avx2Real a, Avx2Real b) { return Avx2Real(_mm256_add_ps(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Real operator-(Avx2Real a, Avx2Real b) { return Avx2Real(_mm256_sub_ps(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Real operator*(Avx2Real a, Avx2Real b) { return Avx2Real(_mm256_mul_ps(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Real operator/(Avx2Real a, Avx2Real b) { return Avx2Real(_mm256_div_ps(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Real operator-(Avx2Real a)
    {
        return Avx2Real(_mm256_xor_ps(a.v, _mm256_set1_ps(-0.0F)));
    }
    SPINDRIFT_FRIEND Avx2Mask operator==(Avx2Real a, Avx2Real b)
    {
        return Avx2Mask(_mm256_cmp_ps(a.v, b.v, _CMP_EQ_OQ));
    }
    SPINDRIFT_FRIEND Avx2Mask operator!=(Avx2Real a, Avx2Real b)
    {
        return Avx2Mask(_mm256_cmp_ps(a.v, b.v, _CMP_NEQ_UQ));
    }
    SPINDRIFT_FRIEND Avx2Mask operator<(Avx2Real a, Avx2Real b)
    {
        return Avx2Mask(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ));
    }
    SPINDRIFT_FRIEND Avx2Mask operator<=(Avx2Real a, Avx2Real b)
    {
        return Avx2Mask(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ));
    }
    SPINDRIFT_FRIEND Avx2Mask operator>(Avx2Real a, Avx2Real b)
    {
        return Avx2Mask(_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ));
    }
    SPINDRIFT_FRIEND Avx2Mask operator>=(Avx2Real a, Avx2Real b)
    {
        return Avx2Mask(_mm256_cmp_ps(a.v, b.v, _CMP_GE_OQ));
    }
    SPINDRIFT_FRIEND Avx2Real select(Avx2Mask m, Avx2Real yes, Avx2Real no)
    {
        return Avx2Real(_mm256_blendv_ps(no.v, yes.v, m.v));
    }
    SPINDRIFT_FRIEND Avx2Real fma(Avx2Real a, Avx2Real b, Avx2Real c)
    {
        return Avx2Real(_mm256_fmadd_ps(a.v, b.v, c.v));
    }
    SPINDRIFT_FRIEND Avx2Real sqrt(Avx2Real a) { return Avx2Real(_mm256_sqrt_ps(a.v)); }
    SPINDRIFT_FRIEND Avx2Real abs(Avx2Real a)
    {
        return Avx2Real(_mm256_andnot_ps(_mm256_set1_ps(-0.0F), a.v));
    }
    SPINDRIFT_FRIEND Avx2Real copysign(Avx2Real size, Avx2Real sign)
    {
        const __m256 top = _mm256_set1_ps(-0.0F);
        return Avx2Real(_mm256_or_ps(_mm256_andnot_ps(top, size.v), _mm256_and_ps(top, sign.v)));
    }
    SPINDRIFT_FRIEND Avx2Real min(Avx2Real a, Avx2Real b) { return Avx2Real(_mm256_min_ps(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Real max(Avx2Real a, Avx2Real b) { return Avx2Real(_mm256_max_ps(a.v, b.v)); }
    SPINDRIFT_FRIEND Avx2Real round(Avx2Real a)
    {
        return Avx2Real(_mm256_round_ps(a.v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
    }
    SPINDRIFT_FRIEND Avx2Real floor(Avx2Real a)
    {
        return Avx2Real(_mm256_round_ps(a.v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC));
    }
    SPINDRIFT_FRIEND Avx2Int truncate_to_int(Avx2Real a) { return Avx2Int(_mm256_cvttps_epi32(a.v)); }
    SPINDRIFT_FRIEND Avx2UInt bits(Avx2Real a) { return Avx2UInt(_mm256_castps_si256(a.v)); }
};

SPINDRIFT_HD Avx2Real from_bits(Avx2UInt b)
{
    return Avx2Real(_mm256_castsi256_ps(b.v));
}

SPINDRIFT_HD Avx2Real gather(const float* base, Avx2Int index)
{
    return Avx2Real(_mm256_i32gather_ps(base, index.v, 4));
}

#undef SPINDRIFT_FRIEND

}  // namespace spindrift::cpu

template <>
struct spindrift::NumberTraits<spindrift::cpu::Avx2Real>
{
    using Mask = cpu::Avx2Mask;
    using Int = cpu::Avx2Int;
    using UInt = cpu::Avx2UInt;
    static constexpr int width = 8;
    static constexpr bool is_double = false;
    static SPINDRIFT_HD cpu::Avx2Real from_int(Int i) { return cpu::Avx2Real(_mm256_cvtepi32_ps(i.v)); }
};
