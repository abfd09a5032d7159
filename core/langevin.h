// SPDX-License-Identifier: MIT
#pragma once

#include "core/number.h"
#include "core/vec.h"
#include "core/wind.h"

namespace spindrift
{

// How a step is cut: docs/decisions/006-one-relaxation-cut-flow.md.

/// Between two relaxations h |dS/dx| stays below this at the steepest place of the world.
inline constexpr double kRelaxationLimit = 0.6;
/// Most relaxations in a step.
inline constexpr int kMostRelaxations = 16;

/// From one relaxation to the next the flow is followed in sub-steps so short that h |dS/dx| stays below
/// this: there the midpoint rule keeps the well-mixed cases at statistical noise.
inline constexpr double kGradientLimit = 0.15;
/// Most sub-steps between two relaxations.
inline constexpr int kMostSubsteps = 16;

/// Most pieces in which a sub-step flows near walls.
inline constexpr int kMostPieces = 16;

/// In how many sub-steps a flake follows the flow for h seconds where the largest |dS/dx| within its reach is
/// `gradient`: 1 … kMostSubsteps.
template <class R>
SPINDRIFT_HD IntOf<R> substeps(const R& gradient, const R& h)
{
    const R most = number<R>(kMostSubsteps);
    const R wanted = number<R>(0.0) - floor(gradient * h * number<R>(-1.0 / kGradientLimit));
    return truncate_to_int(max(min(wanted, most), number<R>(1.0)));
}

/// Pivots below this share of their diagonal are rounding: no stress that is realizable has them.
inline constexpr double kLeastPivotShare = 1e-6;

/// One Ornstein-Uhlenbeck step of q over h seconds, dq = -M q dt + sqrt(C0 eps) S^-1 dW with M = (C0 eps / 2)
/// (S^T S)^-1, by Cayley's r = (1 + h M / 2)^-1 (1 - h M / 2): variance and diffusivity are exact for every
/// h, and the velocity S q has the increments of Kolmogorov, C0 eps dt in all directions alike. With a = C0
/// eps h / 4 it is q' = 2 y - q, (S^T S + a) y = S^T (S q + sqrt(a) noise): nothing is divided by S, which
/// may be zero. `noise`: standard Gaussians. Source: docs/physics.md "Turbulence".
template <class R>
SPINDRIFT_HD Vec3<R> relax(const Air<R>& s, const Vec3<R>& q, const R& a, const Vec3<R>& noise)
{
    const R root = sqrt(a);
    const Vec3<R> w{fma(root, noise.x, s.s11 * q.x), fma(root, noise.y, fma(s.s22, q.y, s.s21 * q.x)),
                    fma(root, noise.z, fma(s.s33, q.z, fma(s.s32, q.y, s.s31 * q.x)))};
    const R t1 = fma(s.s31, w.z, fma(s.s21, w.y, s.s11 * w.x));
    const R t2 = fma(s.s32, w.z, s.s22 * w.y);
    const R t3 = s.s33 * w.z;
    // S^T S, and its LDL^T with a on the diagonal
    const R b12 = fma(s.s31, s.s32, s.s21 * s.s22);
    const R b13 = s.s31 * s.s33;
    const R b23 = s.s32 * s.s33;
    const R a1 = fma(s.s31, s.s31, fma(s.s21, s.s21, fma(s.s11, s.s11, a)));
    const R a2 = fma(s.s32, s.s32, fma(s.s22, s.s22, a));
    const R a3 = fma(s.s33, s.s33, a);
    const R one = number<R>(1.0);
    const R least = number<R>(kLeastPivotShare);
    const R tiny = number<R>(1e-30);
    const R i1 = one / max(a1, tiny);
    const R l21 = b12 * i1;
    const R l31 = b13 * i1;
    const R i2 = one / max(fma(-l21, b12, a2), fma(least, a2, tiny));
    const R m32 = fma(-l31, b12, b23);
    const R l32 = m32 * i2;
    const R i3 = one / max(fma(-l32, m32, fma(-l31, b13, a3)), fma(least, a3, tiny));
    const R z2 = fma(-l21, t1, t2);
    const R z3 = fma(-l32, z2, fma(-l31, t1, t3));
    const R y3 = z3 * i3;
    const R y2 = fma(-l32, y3, z2 * i2);
    const R y1 = fma(-l31, y3, fma(-l21, y2, t1 * i1));
    return {y1 + y1 - q.x, y2 + y2 - q.y, y3 + y3 - q.z};
}

}  // namespace spindrift
