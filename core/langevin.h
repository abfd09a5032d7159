// SPDX-License-Identifier: MIT
#pragma once

#include "core/number.h"
#include "core/vec.h"
#include "core/wind.h"

namespace spindrift
{

/// Sub-steps are made so short that h |dS/dx| stays below this (docs/physics.md "Turbulence", table): there
/// the well-mixed sinusoid is at statistical noise.
inline constexpr double kGradientLimit = 0.15;
/// Most sub-steps that one step is cut into.
inline constexpr int kMostSubsteps = 64;

/// Into how many sub-steps a step of h seconds is cut where the largest |dS/dx| is `gradient`: 1 …
/// kMostSubsteps.
template <class R>
SPINDRIFT_HD IntOf<R> substeps(const R& gradient, const R& h)
{
    const R most = number<R>(kMostSubsteps);
    const R wanted = number<R>(0.0) - floor(gradient * h * number<R>(-1.0 / kGradientLimit));
    return truncate_to_int(max(min(wanted, most), number<R>(1.0)));
}

/// One Ornstein-Uhlenbeck step of a component of unit variance by Cayley's r = (1 - a/2) / (1 + a/2), a =
/// rate h: stationary variance and diffusivity are exact for every a. `noise` is a standard Gaussian. Source:
/// docs/physics.md "Turbulence"; sqrt(1 - r^2) = sqrt(2a) / (1 + a/2) without cancellation.
template <class R>
SPINDRIFT_HD R relax(const R& q, const R& rate, const R& h, const R& noise)
{
    const R a = min(rate * h, number<R>(1e6));  // r is -1 to rounding from here on
    const R half = a * number<R>(0.5);
    const R inverse = number<R>(1.0) / (number<R>(1.0) + half);
    const R r = (number<R>(1.0) - half) * inverse;
    return fma(r, q, sqrt(a + a) * inverse * noise);
}

template <class R>
SPINDRIFT_HD Vec3<R> relax(const Vec3<R>& q, const Vec3<R>& rate, const R& h, const Vec3<R>& noise)
{
    return {relax(q.x, rate.x, h, noise.x), relax(q.y, rate.y, h, noise.y), relax(q.z, rate.z, h, noise.z)};
}

}  // namespace spindrift
