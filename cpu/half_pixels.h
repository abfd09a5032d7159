// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "cpu/pack.h"

// Pixels of four half floats, as many as R has lanes, to planes of red, green and blue and back; alpha is
// written as 1. Rounds to nearest even, denormals count, too large gives infinity. Only kernel translation
// units include it.

namespace spindrift::cpu
{

inline constexpr std::uint32_t kHalfOne = 0x3C00;

SPINDRIFT_HD float from_half(std::uint16_t half)
{
    const std::uint32_t sign = (half & 0x8000U) << 16;
    const std::uint32_t size = (half & 0x7FFFU) << 13;
    if (size >= 0x7C00U << 13) return spindrift::from_bits(sign | size | 0x7F800000U);
    return spindrift::from_bits(bits(spindrift::from_bits(size) * 0x1p112F) | sign);  // exact, denormals too
}

SPINDRIFT_HD std::uint16_t to_half(float x)
{
    const std::uint32_t sign = bits(x) >> 16 & 0x8000U;
    const float size = abs(x);
    if (!(size < 65520.0F)) return static_cast<std::uint16_t>(sign | (size == size ? 0x7C00U : 0x7E00U));
    // Below 2^-14 halves are multiples of 2^-24, above they have 11 bits; adding 2^13 ulps of float rounds
    // there.
    const float magic = max(spindrift::from_bits((bits(size) & 0x7F800000U) + (13U << 23)), 0.5F);
    const float rounded = (size + magic) - magic;
    const std::uint32_t half = rounded < 0x1p-14F ? static_cast<std::uint32_t>(rounded * 0x1p24F)
                                                  : (bits(rounded) - (112U << 23)) >> 13;
    return static_cast<std::uint16_t>(sign | half);
}

SPINDRIFT_HD void load_pixels(const std::uint16_t* from, float& red, float& green, float& blue)
{
    red = from_half(from[0]);
    green = from_half(from[1]);
    blue = from_half(from[2]);
}

SPINDRIFT_HD void store_pixels(std::uint16_t* to, float red, float green, float blue)
{
    to[0] = to_half(red);
    to[1] = to_half(green);
    to[2] = to_half(blue);
    to[3] = kHalfOne;
}

#if defined(__AVX2__) && defined(__F16C__)
SPINDRIFT_HD void load_pixels(const std::uint16_t* from, Avx2Real& red, Avx2Real& green, Avx2Real& blue)
{
    // Pairs of pixels p, p + 4 share a register, so that each channel comes out in order.
    __m256 pair[4];
    for (int p = 0; p < 4; ++p)
    {
        const __m128i low = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + 4 * p));
        const __m128i high = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + 4 * (p + 4)));
        pair[p] = _mm256_cvtph_ps(_mm_unpacklo_epi64(low, high));
    }
    const __m256 rg01 = _mm256_unpacklo_ps(pair[0], pair[1]), rg23 = _mm256_unpacklo_ps(pair[2], pair[3]);
    const __m256 ba01 = _mm256_unpackhi_ps(pair[0], pair[1]), ba23 = _mm256_unpackhi_ps(pair[2], pair[3]);
    red.v = _mm256_shuffle_ps(rg01, rg23, 0x44);
    green.v = _mm256_shuffle_ps(rg01, rg23, 0xEE);
    blue.v = _mm256_shuffle_ps(ba01, ba23, 0x44);
}

SPINDRIFT_HD void store_pixels(std::uint16_t* to, Avx2Real red, Avx2Real green, Avx2Real blue)
{
    const __m256 one = _mm256_set1_ps(1);
    const __m256 rg_low = _mm256_unpacklo_ps(red.v, green.v), rg_high = _mm256_unpackhi_ps(red.v, green.v);
    const __m256 ba_low = _mm256_unpacklo_ps(blue.v, one), ba_high = _mm256_unpackhi_ps(blue.v, one);
    const __m256 pair[4] = {_mm256_shuffle_ps(rg_low, ba_low, 0x44), _mm256_shuffle_ps(rg_low, ba_low, 0xEE),
                            _mm256_shuffle_ps(rg_high, ba_high, 0x44),
                            _mm256_shuffle_ps(rg_high, ba_high, 0xEE)};
    for (int p = 0; p < 4; ++p)
    {
        const __m128i halves = _mm256_cvtps_ph(pair[p], _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
        _mm_storel_epi64(reinterpret_cast<__m128i*>(to + 4 * p), halves);
        _mm_storel_epi64(reinterpret_cast<__m128i*>(to + 4 * (p + 4)), _mm_unpackhi_epi64(halves, halves));
    }
}
#endif

#if defined(__AVX512BW__)
SPINDRIFT_HD void load_pixels(const std::uint16_t* from, Avx512Real& red, Avx512Real& green, Avx512Real& blue)
{
    const __m512i low = _mm512_loadu_si512(from), high = _mm512_loadu_si512(from + 32);
    // Words 0-15: a channel of the 16 pixels, words 16-31: the next one.
    const __m512i step = _mm512_set_epi16(61, 57, 53, 49, 45, 41, 37, 33, 29, 25, 21, 17, 13, 9, 5, 1, 60, 56,
                                          52, 48, 44, 40, 36, 32, 28, 24, 20, 16, 12, 8, 4, 0);
    const __m512i rg = _mm512_permutex2var_epi16(low, step, high);
    const __m512i ba = _mm512_permutex2var_epi16(low, _mm512_add_epi16(step, _mm512_set1_epi16(2)), high);
    red.v = _mm512_cvtph_ps(_mm512_castsi512_si256(rg));
    green.v = _mm512_cvtph_ps(_mm512_extracti64x4_epi64(rg, 1));
    blue.v = _mm512_cvtph_ps(_mm512_castsi512_si256(ba));
}

SPINDRIFT_HD void store_pixels(std::uint16_t* to, Avx512Real red, Avx512Real green, Avx512Real blue)
{
    constexpr int kNearest = _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC;
    const __m512i rg = _mm512_inserti64x4(_mm512_castsi256_si512(_mm512_cvtps_ph(red.v, kNearest)),
                                          _mm512_cvtps_ph(green.v, kNearest), 1);
    const __m512i ba = _mm512_inserti64x4(_mm512_castsi256_si512(_mm512_cvtps_ph(blue.v, kNearest)),
                                          _mm256_set1_epi16(static_cast<short>(kHalfOne)), 1);
    const __m512i first = _mm512_set_epi16(55, 39, 23, 7, 54, 38, 22, 6, 53, 37, 21, 5, 52, 36, 20, 4, 51, 35,
                                           19, 3, 50, 34, 18, 2, 49, 33, 17, 1, 48, 32, 16, 0);
    const __m512i second = _mm512_add_epi16(first, _mm512_set1_epi16(8));
    _mm512_storeu_si512(to, _mm512_permutex2var_epi16(rg, first, ba));
    _mm512_storeu_si512(to + 32, _mm512_permutex2var_epi16(rg, second, ba));
}
#endif

}  // namespace spindrift::cpu
