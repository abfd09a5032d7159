// SPDX-License-Identifier: MIT
#pragma once

#include "core/wind.h"
#include "cpu/pack.h"

// Interpolation in a wind grid for SIMD packs. A wind cell is one cache line, so a lane loads its eight
// records whole and takes their weighted sum across the components; only the result is transposed to one pack
// per component. The operations of each number are those of detail::interpolate_numbers (core/wind.h) in the
// same order: the same bits. Gathers of single numbers took four times as long.

namespace spindrift::cpu
{

#if defined(__AVX2__) && defined(__FMA__)

/// The first four numbers of a record: mean wind and gradient.
SPINDRIFT_HD __m128 interpolate_quarter(const CellCorners& corner, const float* weight, std::size_t stride)
{
    __m128 sum = _mm_mul_ps(_mm_broadcast_ss(weight), _mm_load_ps(corner.at[0]));
#pragma GCC unroll 8
    for (std::size_t c = 1; c < 8; ++c)
        sum = _mm_fmadd_ps(_mm_broadcast_ss(weight + c * stride), _mm_load_ps(corner.at[c]), sum);
    return sum;
}

/// Rows to columns of an 8 x 8 matrix.
SPINDRIFT_HD void transpose(__m256 (&r)[8])
{
    __m256 t[8];
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i)
    {
        t[2 * i] = _mm256_unpacklo_ps(r[2 * i], r[2 * i + 1]);
        t[2 * i + 1] = _mm256_unpackhi_ps(r[2 * i], r[2 * i + 1]);
    }
    __m256 u[8];
#pragma GCC unroll 2
    for (int i = 0; i < 2; ++i)
    {
        u[4 * i] = _mm256_shuffle_ps(t[4 * i], t[4 * i + 2], 0x44);
        u[4 * i + 1] = _mm256_shuffle_ps(t[4 * i], t[4 * i + 2], 0xEE);
        u[4 * i + 2] = _mm256_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0x44);
        u[4 * i + 3] = _mm256_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0xEE);
    }
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i)
    {
        r[i] = _mm256_permute2f128_ps(u[i], u[i + 4], 0x20);
        r[i + 4] = _mm256_permute2f128_ps(u[i], u[i + 4], 0x31);
    }
}

/// Indices and weights of a pack of points in memory, where lanes are broadcast from.
struct Avx2GridLanes
{
    alignas(32) std::int32_t index[8];
    alignas(32) float weight[8][8];  ///< by corner and lane

    SPINDRIFT_HD explicit Avx2GridLanes(const GridPoint<Avx2Real>& p)
    {
        store(index, p.index);
        Avx2Real w[8];
        corner_weights(p, w);
#pragma GCC unroll 8
        for (int c = 0; c < 8; ++c) store(weight[c], w[c]);
    }
};

SPINDRIFT_HD Air<Avx2Real> interpolate_air(const GridWind& grid, const GridPoint<Avx2Real>& p)
{
    const Avx2GridLanes lanes(p);
    __m256 low[8], high[8];  // numbers 0-7 and 8-15 of each lane
#pragma GCC unroll 8
    for (int l = 0; l < 8; ++l)
    {
        const CellCorners corner(grid, lanes.index[l]);
        const __m256 first = _mm256_broadcast_ss(&lanes.weight[0][l]);
        low[l] = _mm256_mul_ps(first, _mm256_load_ps(corner.at[0]));
        high[l] = _mm256_mul_ps(first, _mm256_load_ps(corner.at[0] + 8));
#pragma GCC unroll 8
        for (int c = 1; c < 8; ++c)
        {
            const __m256 weight = _mm256_broadcast_ss(&lanes.weight[c][l]);
            low[l] = _mm256_fmadd_ps(weight, _mm256_load_ps(corner.at[c]), low[l]);
            high[l] = _mm256_fmadd_ps(weight, _mm256_load_ps(corner.at[c] + 8), high[l]);
        }
    }
    transpose(low);
    transpose(high);
    Avx2Real numbers[16];
#pragma GCC unroll 8
    for (int i = 0; i < 8; ++i) numbers[i] = Avx2Real(low[i]), numbers[8 + i] = Avx2Real(high[i]);
    return air_of_record(numbers);
}

SPINDRIFT_HD Vec3<Avx2Real> interpolate_mean(const GridWind& grid, const GridPoint<Avx2Real>& p)
{
    const Avx2GridLanes lanes(p);
    __m256 rows[8];
#pragma GCC unroll 8
    for (int l = 0; l < 8; ++l)
        rows[l] = _mm256_castps128_ps256(
            interpolate_quarter(CellCorners(grid, lanes.index[l]), &lanes.weight[0][l], 8));
    transpose(rows);
    return {Avx2Real(rows[0]), Avx2Real(rows[1]), Avx2Real(rows[2])};
}

#endif

#if defined(__AVX512F__) && defined(__AVX512DQ__)

/// Rows to columns of a 16 x 16 matrix.
SPINDRIFT_HD void transpose(__m512 (&r)[16])
{
    __m512 t[16];
#pragma GCC unroll 8
    for (int i = 0; i < 8; ++i)
    {
        t[2 * i] = _mm512_unpacklo_ps(r[2 * i], r[2 * i + 1]);
        t[2 * i + 1] = _mm512_unpackhi_ps(r[2 * i], r[2 * i + 1]);
    }
    // u[4 i + c]: column c, c + 4, c + 8, c + 12 of rows 4 i … 4 i + 3, one 128-bit part each
    __m512 u[16];
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i)
    {
        u[4 * i] = _mm512_shuffle_ps(t[4 * i], t[4 * i + 2], 0x44);
        u[4 * i + 1] = _mm512_shuffle_ps(t[4 * i], t[4 * i + 2], 0xEE);
        u[4 * i + 2] = _mm512_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0x44);
        u[4 * i + 3] = _mm512_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0xEE);
    }
#pragma GCC unroll 4
    for (int c = 0; c < 4; ++c)
    {
        const __m512 low01 = _mm512_shuffle_f32x4(u[c], u[4 + c], 0x88);       // parts 0 and 2 of rows 0-7
        const __m512 low23 = _mm512_shuffle_f32x4(u[8 + c], u[12 + c], 0x88);  // … of rows 8-15
        const __m512 high01 = _mm512_shuffle_f32x4(u[c], u[4 + c], 0xDD);      // parts 1 and 3
        const __m512 high23 = _mm512_shuffle_f32x4(u[8 + c], u[12 + c], 0xDD);
        r[c] = _mm512_shuffle_f32x4(low01, low23, 0x88);
        r[c + 8] = _mm512_shuffle_f32x4(low01, low23, 0xDD);
        r[c + 4] = _mm512_shuffle_f32x4(high01, high23, 0x88);
        r[c + 12] = _mm512_shuffle_f32x4(high01, high23, 0xDD);
    }
}

struct Avx512GridLanes
{
    alignas(64) std::int32_t index[16];
    alignas(64) float weight[8][16];  ///< by corner and lane

    SPINDRIFT_HD explicit Avx512GridLanes(const GridPoint<Avx512Real>& p)
    {
        store(index, p.index);
        Avx512Real w[8];
        corner_weights(p, w);
#pragma GCC unroll 8
        for (int c = 0; c < 8; ++c) store(weight[c], w[c]);
    }
};

SPINDRIFT_HD Air<Avx512Real> interpolate_air(const GridWind& grid, const GridPoint<Avx512Real>& p)
{
    const Avx512GridLanes lanes(p);
    __m512 rows[16];
#pragma GCC unroll 16
    for (int l = 0; l < 16; ++l)
    {
        const CellCorners corner(grid, lanes.index[l]);
        rows[l] = _mm512_mul_ps(_mm512_set1_ps(lanes.weight[0][l]), _mm512_load_ps(corner.at[0]));
#pragma GCC unroll 8
        for (int c = 1; c < 8; ++c)
            rows[l] =
                _mm512_fmadd_ps(_mm512_set1_ps(lanes.weight[c][l]), _mm512_load_ps(corner.at[c]), rows[l]);
    }
    transpose(rows);
    Avx512Real numbers[16];
#pragma GCC unroll 16
    for (int i = 0; i < 16; ++i) numbers[i] = Avx512Real(rows[i]);
    return air_of_record(numbers);
}

SPINDRIFT_HD Vec3<Avx512Real> interpolate_mean(const GridWind& grid, const GridPoint<Avx512Real>& p)
{
    const Avx512GridLanes lanes(p);
    __m512 rows[16];
#pragma GCC unroll 16
    for (int l = 0; l < 16; ++l)
        rows[l] = _mm512_castps128_ps512(
            interpolate_quarter(CellCorners(grid, lanes.index[l]), &lanes.weight[0][l], 16));
    transpose(rows);
    return {Avx512Real(rows[0]), Avx512Real(rows[1]), Avx512Real(rows[2])};
}

#endif

}  // namespace spindrift::cpu
