// SPDX-License-Identifier: MIT
#pragma once

#include "core/wind.h"
#include "cpu/pack.h"

// Interpolation in a wind grid for SIMD packs. A wind cell is one cache line, so a lane loads its eight
// records whole and interpolates across their components; only the result is transposed to one pack per
// component. The operations of each number are those of detail::trilinear (core/wind.h) in the same order:
// the same bits. Gathers of single numbers took four times as long.

namespace spindrift::cpu
{

#if defined(__AVX2__) && defined(__FMA__)

SPINDRIFT_HD __m128 lerp_record(__m128 a, __m128 b, __m128 t)
{
    return _mm_fmadd_ps(t, _mm_sub_ps(b, a), a);
}

SPINDRIFT_HD __m256 lerp_record(__m256 a, __m256 b, __m256 t)
{
    return _mm256_fmadd_ps(t, _mm256_sub_ps(b, a), a);
}

/// The first four numbers of the record at `cell`: mean wind and gradient.
SPINDRIFT_HD __m128 interpolate_quarter(const GridWind& grid, const WindCell* cell, __m128 fx, __m128 fy,
                                        __m128 fz)
{
    const auto at = [&](int offset) { return _mm_load_ps(&cell[offset].u); };
    const int sx = grid.step_x;
    const int sy = grid.step_y;
    const int sz = grid.step_z;
    const __m128 y0z0 = lerp_record(at(0), at(sx), fx);
    const __m128 y1z0 = lerp_record(at(sy), at(sy + sx), fx);
    const __m128 y0z1 = lerp_record(at(sz), at(sz + sx), fx);
    const __m128 y1z1 = lerp_record(at(sz + sy), at(sz + sy + sx), fx);
    return lerp_record(lerp_record(y0z0, y1z0, fy), lerp_record(y0z1, y1z1, fy), fz);
}

#endif

#if defined(__AVX2__) && defined(__FMA__)

/// Eight numbers of the record from `part` (0 or 8) on.
SPINDRIFT_HD __m256 interpolate_half(const GridWind& grid, const WindCell* cell, int part, __m256 fx,
                                     __m256 fy, __m256 fz)
{
    const auto at = [&](int offset) { return _mm256_load_ps(&cell[offset].u + part); };
    const int sx = grid.step_x;
    const int sy = grid.step_y;
    const int sz = grid.step_z;
    const __m256 y0z0 = lerp_record(at(0), at(sx), fx);
    const __m256 y1z0 = lerp_record(at(sy), at(sy + sx), fx);
    const __m256 y0z1 = lerp_record(at(sz), at(sz + sx), fx);
    const __m256 y1z1 = lerp_record(at(sz + sy), at(sz + sy + sx), fx);
    return lerp_record(lerp_record(y0z0, y1z0, fy), lerp_record(y0z1, y1z1, fy), fz);
}

/// Rows to columns of an 8 x 8 matrix.
SPINDRIFT_HD void transpose(__m256 (&r)[8])
{
    __m256 t[8];
    for (int i = 0; i < 4; ++i)
    {
        t[2 * i] = _mm256_unpacklo_ps(r[2 * i], r[2 * i + 1]);
        t[2 * i + 1] = _mm256_unpackhi_ps(r[2 * i], r[2 * i + 1]);
    }
    __m256 u[8];
    for (int i = 0; i < 2; ++i)
    {
        u[4 * i] = _mm256_shuffle_ps(t[4 * i], t[4 * i + 2], 0x44);
        u[4 * i + 1] = _mm256_shuffle_ps(t[4 * i], t[4 * i + 2], 0xEE);
        u[4 * i + 2] = _mm256_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0x44);
        u[4 * i + 3] = _mm256_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0xEE);
    }
    for (int i = 0; i < 4; ++i)
    {
        r[i] = _mm256_permute2f128_ps(u[i], u[i + 4], 0x20);
        r[i + 4] = _mm256_permute2f128_ps(u[i], u[i + 4], 0x31);
    }
}

/// Shares and indices of a GridPoint in memory, where lanes are broadcast from.
struct Avx2GridLanes
{
    alignas(32) std::int32_t index[8];
    alignas(32) float fx[8], fy[8], fz[8];

    SPINDRIFT_HD explicit Avx2GridLanes(const GridPoint<Avx2Real>& p)
    {
        store(index, p.index);
        store(fx, p.fx);
        store(fy, p.fy);
        store(fz, p.fz);
    }
};

SPINDRIFT_HD Air<Avx2Real> interpolate_air(const GridWind& grid, const GridPoint<Avx2Real>& p)
{
    const Avx2GridLanes lanes(p);
    Avx2Real numbers[16];
#pragma GCC unroll 2
    for (int part = 0; part < 16; part += 8)
    {
        __m256 rows[8];
#pragma GCC unroll 8
        for (int l = 0; l < 8; ++l)
            rows[l] =
                interpolate_half(grid, grid.cells + lanes.index[l], part, _mm256_broadcast_ss(lanes.fx + l),
                                 _mm256_broadcast_ss(lanes.fy + l), _mm256_broadcast_ss(lanes.fz + l));
        transpose(rows);
        for (int i = 0; i < 8; ++i) numbers[part + i] = Avx2Real(rows[i]);
    }
    return air_of_record(numbers);
}

SPINDRIFT_HD Vec3<Avx2Real> interpolate_mean(const GridWind& grid, const GridPoint<Avx2Real>& p)
{
    const Avx2GridLanes lanes(p);
    __m256 rows[8];
#pragma GCC unroll 8
    for (int l = 0; l < 8; ++l)
        rows[l] = _mm256_castps128_ps256(
            interpolate_quarter(grid, grid.cells + lanes.index[l], _mm_broadcast_ss(lanes.fx + l),
                                _mm_broadcast_ss(lanes.fy + l), _mm_broadcast_ss(lanes.fz + l)));
    transpose(rows);
    return {Avx2Real(rows[0]), Avx2Real(rows[1]), Avx2Real(rows[2])};
}

#endif

#if defined(__AVX512F__) && defined(__AVX512DQ__)

SPINDRIFT_HD __m512 lerp_record(__m512 a, __m512 b, __m512 t)
{
    return _mm512_fmadd_ps(t, _mm512_sub_ps(b, a), a);
}

/// All sixteen numbers of the record.
SPINDRIFT_HD __m512 interpolate_record(const GridWind& grid, const WindCell* cell, __m512 fx, __m512 fy,
                                       __m512 fz)
{
    const auto at = [&](int offset) { return _mm512_load_ps(&cell[offset].u); };
    const int sx = grid.step_x;
    const int sy = grid.step_y;
    const int sz = grid.step_z;
    const __m512 y0z0 = lerp_record(at(0), at(sx), fx);
    const __m512 y1z0 = lerp_record(at(sy), at(sy + sx), fx);
    const __m512 y0z1 = lerp_record(at(sz), at(sz + sx), fx);
    const __m512 y1z1 = lerp_record(at(sz + sy), at(sz + sy + sx), fx);
    return lerp_record(lerp_record(y0z0, y1z0, fy), lerp_record(y0z1, y1z1, fy), fz);
}

/// Rows to columns of a 16 x 16 matrix.
SPINDRIFT_HD void transpose(__m512 (&r)[16])
{
    __m512 t[16];
    for (int i = 0; i < 8; ++i)
    {
        t[2 * i] = _mm512_unpacklo_ps(r[2 * i], r[2 * i + 1]);
        t[2 * i + 1] = _mm512_unpackhi_ps(r[2 * i], r[2 * i + 1]);
    }
    // u[4 i + c]: column c, c + 4, c + 8, c + 12 of rows 4 i … 4 i + 3, one 128-bit part each
    __m512 u[16];
    for (int i = 0; i < 4; ++i)
    {
        u[4 * i] = _mm512_shuffle_ps(t[4 * i], t[4 * i + 2], 0x44);
        u[4 * i + 1] = _mm512_shuffle_ps(t[4 * i], t[4 * i + 2], 0xEE);
        u[4 * i + 2] = _mm512_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0x44);
        u[4 * i + 3] = _mm512_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0xEE);
    }
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
    alignas(64) float fx[16], fy[16], fz[16];

    SPINDRIFT_HD explicit Avx512GridLanes(const GridPoint<Avx512Real>& p)
    {
        store(index, p.index);
        store(fx, p.fx);
        store(fy, p.fy);
        store(fz, p.fz);
    }
};

SPINDRIFT_HD Air<Avx512Real> interpolate_air(const GridWind& grid, const GridPoint<Avx512Real>& p)
{
    const Avx512GridLanes lanes(p);
    __m512 rows[16];
#pragma GCC unroll 16
    for (int l = 0; l < 16; ++l)
        rows[l] = interpolate_record(grid, grid.cells + lanes.index[l], _mm512_set1_ps(lanes.fx[l]),
                                     _mm512_set1_ps(lanes.fy[l]), _mm512_set1_ps(lanes.fz[l]));
    transpose(rows);
    Avx512Real numbers[16];
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
            interpolate_quarter(grid, grid.cells + lanes.index[l], _mm_broadcast_ss(lanes.fx + l),
                                _mm_broadcast_ss(lanes.fy + l), _mm_broadcast_ss(lanes.fz + l)));
    transpose(rows);
    return {Avx512Real(rows[0]), Avx512Real(rows[1]), Avx512Real(rows[2])};
}

#endif

}  // namespace spindrift::cpu
