// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math.h"
#include "core/number.h"
#include "core/turbulence.h"
#include "core/vec.h"
#include "core/world.h"

namespace spindrift
{

/// The air at a point: mean velocity and what the whitened Langevin model needs of the turbulence.
/// Source: docs/physics.md "Wind" and "Turbulence".
template <class R>
struct Air
{
    Vec3<R> mean;                    ///< m/s
    R s11, s21, s22, s31, s32, s33;  ///< lower-triangular root of the stress tensor, m/s
    Vec3<R> div_s;                   ///< d_i S_ij for j = 1, 2, 3, in 1/s
    R c0_eps;                        ///< C0 eps, m2/s3, not negative
    R gradient;                      ///< largest |dS/dx|, 1/s
};

/// S q: the turbulent velocity of a flake, m/s.
template <class R>
SPINDRIFT_HD Vec3<R> turbulent_velocity(const Air<R>& air, const Vec3<R>& q)
{
    return {air.s11 * q.x, fma(air.s22, q.y, air.s21 * q.x),
            fma(air.s33, q.z, fma(air.s32, q.y, air.s31 * q.x))};
}

/// The neutral surface layer over a plane (docs/physics.md "Wind"): one matrix scaled by f(z) = u* (1 -
/// d/zi)^(3/4), d the height above the ground. Made by surface_layer(); plain numbers, so that any thread may
/// have a copy.
struct SurfaceLayer
{
    float friction_velocity_m_s = 0;
    float ground_m = 0;
    float inverse_boundary_layer_per_m = 0;
    float roughness_m = 0.1F;
    float s11 = 0, s21 = 0, s22 = 0, s31 = 0, s32 = 0, s33 = 0;  ///< root of the stress tensor over f^2
    float dissipation = 0;  ///< C0 eps at 1 m, without its decline, m2/s3
    float largest_s = 0;
};

/// The neutral surface layer of core/turbulence.h over the ground of Wind.
inline SurfaceLayer surface_layer(const Wind& wind)
{
    const double c = wind.to_x;
    const double s = wind.to_y;
    Stress<double> stress = neutral_normal_stress(c, s);
    stress.xz = -c, stress.yz = -s;
    const StressRoot<double> root = stress_root(stress);
    const auto f = [](double v) { return static_cast<float>(v); };
    SurfaceLayer layer;
    layer.friction_velocity_m_s = wind.friction_velocity_m_s;
    layer.ground_m = wind.ground_m;
    layer.inverse_boundary_layer_per_m = f(1.0 / static_cast<double>(wind.boundary_layer_m));
    layer.roughness_m = wind.roughness_m;
    layer.s11 = f(root.s11), layer.s21 = f(root.s21), layer.s22 = f(root.s22);
    layer.s31 = f(root.s31), layer.s32 = f(root.s32), layer.s33 = f(root.s33);
    layer.dissipation = f(neutral_dissipation(static_cast<double>(wind.friction_velocity_m_s), 1.0));
    layer.largest_s = f(max(root.s11, max(abs(root.s22), root.s33)));
    return layer;
}

/// Turbulence of a surface layer at height z (m); leaves `air.mean` alone.
template <class R>
SPINDRIFT_HD void sample_surface_layer(const SurfaceLayer& layer, const R& z, Air<R>& air)
{
    const R d = max(z - R(layer.ground_m), R(layer.roughness_m));
    const R part = d * R(layer.inverse_boundary_layer_per_m);
    const R share = layer_share(part);
    const R root = sqrt(share);
    const R quarter = sqrt(root);
    const R f = R(layer.friction_velocity_m_s) * (root * quarter);
    // f' = -3/4 u* / zi share^(-1/4); nothing changes any more where the share stands at its floor
    const R slope = select(
        share > number<R>(kLeastLayerShare),
        number<R>(-0.75) * R(layer.friction_velocity_m_s) * R(layer.inverse_boundary_layer_per_m) / quarter,
        number<R>(0.0));
    air.s11 = f * R(layer.s11);
    air.s21 = f * R(layer.s21);
    air.s22 = f * R(layer.s22);
    air.s31 = f * R(layer.s31);
    air.s32 = f * R(layer.s32);
    air.s33 = f * R(layer.s33);
    air.div_s = {slope * R(layer.s31), slope * R(layer.s32), slope * R(layer.s33)};
    air.c0_eps = R(layer.dissipation) * dissipation_decline(part) / d;
    air.gradient = abs(slope) * R(layer.largest_s);
}

/// The same mean wind everywhere; turbulence of the surface layer.
struct UniformWind
{
    Vec3f mean_m_s{};
    SurfaceLayer layer;

    template <class R>
    SPINDRIFT_HD Vec3<R> mean(const Vec3<R>&) const
    {
        return {R(mean_m_s.x), R(mean_m_s.y), R(mean_m_s.z)};
    }

    template <class R>
    SPINDRIFT_HD Air<R> air(const Vec3<R>& x) const
    {
        Air<R> a;
        a.mean = mean(x);
        sample_surface_layer(layer, x.z, a);
        return a;
    }
};

/// U(d) = u* / kappa ln((d + z0) / z0) along `to`, calm at the ground.
struct LogWind
{
    SurfaceLayer layer;
    float to_x = 1, to_y = 0;

    template <class R>
    SPINDRIFT_HD Vec3<R> mean(const Vec3<R>& x) const
    {
        const R z0 = R(layer.roughness_m);
        const R d = max(x.z - R(layer.ground_m), number<R>(0.0));
        const R speed = R(layer.friction_velocity_m_s) * number<R>(1.0 / kVonKarman) * log((d + z0) / z0);
        return {speed * R(to_x), speed * R(to_y), number<R>(0.0)};
    }

    template <class R>
    SPINDRIFT_HD Air<R> air(const Vec3<R>& x) const
    {
        Air<R> a;
        a.mean = mean(x);
        sample_surface_layer(layer, x.z, a);
        return a;
    }
};

/// Cells of a wind grid around a point: the lower corner's index and the shares of the upper ones.
template <class R>
struct GridPoint
{
    IntOf<R> index;
    R fx, fy, fz;  ///< in [0, 1]
};

/// The grid of World::wind; does not own its cells. Outside the centres of the outermost cells their values
/// hold.
struct GridWind
{
    const WindCell* cells = nullptr;
    int nx = 1, ny = 1, nz = 1;
    int step_x = 1, step_y = 1, step_z = 1;  ///< to the upper neighbour; 0 along an axis of one cell
    Vec3f origin_m{};
    Vec3f per_cell{1, 1, 1};  ///< 1 / cell size

    template <class R>
    SPINDRIFT_HD GridPoint<R> locate(const Vec3<R>& x) const
    {
        GridPoint<R> p;
        const IntOf<R> ix = axis(x.x, origin_m.x, per_cell.x, nx, p.fx);
        const IntOf<R> iy = axis(x.y, origin_m.y, per_cell.y, ny, p.fy);
        const IntOf<R> iz = axis(x.z, origin_m.z, per_cell.z, nz, p.fz);
        p.index = (iz * IntOf<R>(ny) + iy) * IntOf<R>(nx) + ix;
        return p;
    }

    template <class R>
    SPINDRIFT_HD Vec3<R> mean(const Vec3<R>& x) const
    {
        return interpolate_mean(*this, locate(x));
    }

    template <class R>
    SPINDRIFT_HD Air<R> air(const Vec3<R>& x) const
    {
        return interpolate_air(*this, locate(x));
    }

  private:
    template <class R>
    SPINDRIFT_HD static IntOf<R> axis(const R& x, float origin, float per_cell_, int n, R& share)
    {
        const R last = number<R>(static_cast<double>(n - 1));
        const R at = min(max((x - R(origin)) * R(per_cell_), number<R>(0.0)), last);
        const IntOf<R> lower = min(truncate_to_int(at), IntOf<R>(n > 1 ? n - 2 : 0));
        share = at - to_real<R>(lower);
        return lower;
    }
};

inline GridWind grid_wind(const Wind& wind, const WindCell* cells)
{
    GridWind g;
    g.cells = cells;
    g.nx = wind.nx, g.ny = wind.ny, g.nz = wind.nz;
    g.step_x = wind.nx > 1 ? 1 : 0;
    g.step_y = wind.ny > 1 ? wind.nx : 0;
    g.step_z = wind.nz > 1 ? wind.nx * wind.ny : 0;
    g.origin_m = wind.origin_m;
    g.per_cell = {1 / wind.cell_m.x, 1 / wind.cell_m.y, 1 / wind.cell_m.z};
    return g;
}

/// The sixteen numbers of a WindCell, by name.
template <class R>
SPINDRIFT_HD Air<R> air_of_record(const R (&v)[16])
{
    Air<R> a;
    a.mean = {v[0], v[1], v[2]};
    a.gradient = v[3];
    a.s11 = v[4], a.s21 = v[5], a.s22 = v[6], a.s31 = v[7], a.s32 = v[8], a.s33 = v[9];
    a.div_s = {v[10], v[11], v[12]};
    a.c0_eps = v[13];
    return a;
}

/// Shares of the eight cells round a point: bit 0 of the index is the upper one along x, bit 1 y, bit 2 z.
template <class R>
SPINDRIFT_HD void corner_weights(const GridPoint<R>& p, R (&weight)[8])
{
    const R one = number<R>(1.0);
    const R gx = one - p.fx;
    const R gy = one - p.fy;
    const R gz = one - p.fz;
    const R y0z0 = gy * gz;
    const R y1z0 = p.fy * gz;
    const R y0z1 = gy * p.fz;
    const R y1z1 = p.fy * p.fz;
    weight[0] = gx * y0z0, weight[1] = p.fx * y0z0;
    weight[2] = gx * y1z0, weight[3] = p.fx * y1z0;
    weight[4] = gx * y0z1, weight[5] = p.fx * y0z1;
    weight[6] = gx * y1z1, weight[7] = p.fx * y1z1;
}

/// Start of the eight records round a point.
struct CellCorners
{
    const float* at[8];

    SPINDRIFT_HD CellCorners(const GridWind& grid, std::int32_t index)
    {
        const WindCell* const lower = grid.cells + index;
        at[0] = &lower->u;
        at[2] = &lower[grid.step_y].u;
        at[4] = &lower[grid.step_z].u;
        at[6] = &lower[grid.step_z + grid.step_y].u;
        const std::ptrdiff_t x = std::ptrdiff_t{grid.step_x} * 16;
        for (int c = 0; c < 8; c += 2) at[c + 1] = at[c] + x;
    }
};

// float and double; packs bring their own overloads (cpu/pack_grid.h), which read a record per load. The
// terms are summed in the order of the corners everywhere.

namespace detail
{

/// A quarter of a wind cell.
struct alignas(16) CellRecord
{
    float numbers[4];
};

/// In one access; a device reads it through the cache for data that nobody writes.
SPINDRIFT_HD CellRecord load_record(const float* from)
{
#if defined(__CUDA_ARCH__)
    const float4 four = __ldg(reinterpret_cast<const float4*>(from));
    return {{four.x, four.y, four.z, four.w}};
#else
    return {{from[0], from[1], from[2], from[3]}};
#endif
}

template <int Count, class R>
SPINDRIFT_HD void interpolate_numbers(const GridWind& grid, const GridPoint<R>& p, R* numbers)
{
    R weight[8];
    corner_weights(p, weight);
    const CellCorners corner(grid, p.index);
    for (int first = 0; first < Count; first += 4)
    {
        R sum[4];
        for (int c = 0; c < 8; ++c)
        {
            const CellRecord record = load_record(corner.at[c] + first);
            for (int i = 0; i < 4; ++i)
            {
                const R value = static_cast<R>(record.numbers[i]);
                sum[i] = c == 0 ? weight[0] * value : fma(weight[c], value, sum[i]);
            }
        }
        for (int i = 0; i < 4 && first + i < Count; ++i) numbers[first + i] = sum[i];
    }
}

}  // namespace detail

template <class R>
requires(NumberTraits<R>::width == 1) SPINDRIFT_HD Vec3<R> interpolate_mean(const GridWind& grid,
                                                                            const GridPoint<R>& p)
{
    R v[3];
    detail::interpolate_numbers<3>(grid, p, v);
    return {v[0], v[1], v[2]};
}

template <class R>
requires(NumberTraits<R>::width == 1) SPINDRIFT_HD Air<R> interpolate_air(const GridWind& grid,
                                                                          const GridPoint<R>& p)
{
    R v[16];
    detail::interpolate_numbers<16>(grid, p, v);
    return air_of_record(v);
}

}  // namespace spindrift
