// SPDX-License-Identifier: MIT
#pragma once

#include "core/number.h"
#include "core/vec.h"

namespace spindrift
{

// From a stress tensor to what the whitened Langevin model needs of it (docs/physics.md "Turbulence"), and
// the neutral surface-layer closure that stands in where no stress is known. R is float or double.

/// Reynolds stress <u'_i u'_j>, symmetric, m2/s2.
template <class R>
struct Stress
{
    R xx, xy, xz, yy, yz, zz;
};

/// Lower-triangular S with S S^T = stress, m/s.
template <class R>
struct StressRoot
{
    R s11, s21, s22, s31, s32, s33;
};

/// Smallest eigenvalue of a realizable stress over the sum of its positive ones. In the neutral surface layer
/// the share is 0.12, so the floor touches only what no real turbulence has. Relative, so that calm air is
/// not disturbed.
inline constexpr double kRealizabilityFloor = 0.01;

namespace detail
{

/// One Jacobi rotation that makes a[p][q] zero; the columns of v collect the rotations. Golub & Van Loan,
/// section 8.5.
template <class R>
SPINDRIFT_HD void jacobi_rotate(R (&a)[3][3], R (&v)[3][3], int p, int q)
{
    if (a[p][q] == R(0)) return;
    const R theta = (a[q][q] - a[p][p]) / (R(2) * a[p][q]);
    const R size = R(1) / (abs(theta) + sqrt(theta * theta + R(1)));
    const R t = theta < R(0) ? -size : size;
    const R c = R(1) / sqrt(t * t + R(1));
    const R s = t * c;
    for (int k = 0; k < 3; ++k)
    {
        const R kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq;
        a[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 3; ++k)
    {
        const R pk = a[p][k], qk = a[q][k];
        a[p][k] = c * pk - s * qk;
        a[q][k] = s * pk + c * qk;
        const R vp = v[k][p], vq = v[k][q];
        v[k][p] = c * vp - s * vq;
        v[k][q] = s * vp + c * vq;
    }
    a[p][q] = a[q][p] = R(0);
}

template <class R>
SPINDRIFT_HD R largest_element(const Stress<R>& t)
{
    const R diagonal = max(abs(t.xx), max(abs(t.yy), abs(t.zz)));
    return max(diagonal, max(abs(t.xy), max(abs(t.xz), abs(t.yz))));
}

}  // namespace detail

/// The nearest stress (Frobenius norm) whose eigenvalues are at least kRealizabilityFloor of the positive
/// ones' sum. A stress that already is comes back unchanged; one without any positive eigenvalue, or zero,
/// becomes zero. Every element must be finite.
template <class R>
SPINDRIFT_HD Stress<R> realizable(const Stress<R>& given)
{
    const R scale = detail::largest_element(given);
    if (!(scale > R(0))) return {};
    R a[3][3] = {{given.xx / scale, given.xy / scale, given.xz / scale},
                 {given.xy / scale, given.yy / scale, given.yz / scale},
                 {given.xz / scale, given.yz / scale, given.zz / scale}};
    R v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int sweep = 0; sweep < 8; ++sweep)  // quadratic convergence: 5 sweeps reach double precision
    {
        detail::jacobi_rotate(a, v, 0, 1);
        detail::jacobi_rotate(a, v, 0, 2);
        detail::jacobi_rotate(a, v, 1, 2);
    }
    const R positive = max(a[0][0], R(0)) + max(a[1][1], R(0)) + max(a[2][2], R(0));
    const R floor_value = R(kRealizabilityFloor) * positive;
    R lambda[3];
    bool clipped = false;
    for (int k = 0; k < 3; ++k)
    {
        clipped = clipped || a[k][k] < floor_value;
        lambda[k] = scale * max(a[k][k], floor_value);
    }
    if (!clipped) return given;
    const auto element = [&](int i, int j)
    { return lambda[0] * v[i][0] * v[j][0] + lambda[1] * v[i][1] * v[j][1] + lambda[2] * v[i][2] * v[j][2]; };
    return {element(0, 0), element(0, 1), element(0, 2), element(1, 1), element(1, 2), element(2, 2)};
}

/// Cholesky factor of a realizable stress; zero for a zero stress.
template <class R>
SPINDRIFT_HD StressRoot<R> stress_root(const Stress<R>& t)
{
    StressRoot<R> s{};
    s.s11 = sqrt(max(t.xx, R(0)));
    if (!(s.s11 > R(0))) return {};
    s.s21 = t.xy / s.s11;
    s.s31 = t.xz / s.s11;
    s.s22 = sqrt(max(t.yy - s.s21 * s.s21, R(0)));
    if (!(s.s22 > R(0))) return {};
    s.s32 = (t.yz - s.s31 * s.s21) / s.s22;
    s.s33 = sqrt(max(t.zz - s.s31 * s.s31 - s.s32 * s.s32, R(0)));
    return s;
}

// The neutral surface layer. f = u* (1 - d/zi)^(3/4) scales sigma = (2.5, 2.0, 1.3) f along, across and up,
// u'w' = -f^2 along the wind (Panofsky & Dutton 1984, as in QUIC); C0 eps = 5.7 u*^3 / (kappa d) (1 - 0.85
// d/zi)^(3/2). d: height above the ground, zi: depth of the boundary layer.

inline constexpr double kVonKarman = 0.4;
inline constexpr double kSigmaAlong = 2.5, kSigmaAcross = 2.0, kSigmaUp = 1.3;
/// Kolmogorov constant C0 of the Lagrangian structure function, as QUIC and QES set it.
inline constexpr double kKolmogorovC0 = 5.7;

/// What is left of the boundary layer above a height is never taken smaller than this share: the closure ends
/// at zi, and its gradient is infinite there.
inline constexpr double kLeastLayerShare = 0.02;

/// (f / u*)^(4/3) at d/zi = part.
template <class R>
SPINDRIFT_HD R layer_share(const R& part)
{
    return max(number<R>(1.0) - part, number<R>(kLeastLayerShare));
}

/// (1 - 0.85 part)^(3/2), held above 0.
template <class R>
SPINDRIFT_HD R dissipation_decline(const R& part)
{
    const R decline = max(fma(number<R>(-0.85), part, number<R>(1.0)), number<R>(0.01));
    return decline * sqrt(decline);
}

/// Stress without its shear, for f = 1 and a wind that blows to the unit vector (to_x, to_y): which way the
/// air shears is for the caller to add (-to_x, -to_y over a plane).
template <class R>
SPINDRIFT_HD Stress<R> neutral_normal_stress(R to_x, R to_y)
{
    const R along = R(kSigmaAlong * kSigmaAlong), across = R(kSigmaAcross * kSigmaAcross);
    return {along * to_x * to_x + across * to_y * to_y,
            (along - across) * to_x * to_y,
            R(0),
            along * to_y * to_y + across * to_x * to_x,
            R(0),
            R(kSigmaUp * kSigmaUp)};
}

/// C0 eps (m2/s3) at a distance d (m) from the wall, without its decline to the top of the boundary layer.
template <class R>
SPINDRIFT_HD R neutral_dissipation(R friction_velocity_m_s, R distance_m)
{
    const R u = friction_velocity_m_s;
    return R(kKolmogorovC0 / kVonKarman) * u * u * u / distance_m;
}

}  // namespace spindrift
