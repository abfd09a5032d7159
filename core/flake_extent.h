// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/flake_words.h"
#include "core/math.h"
#include "core/number.h"
#include "core/platform.h"
#include "core/vec.h"

namespace spindrift
{

/// Where the living flakes are, and how many of them are out of control.
struct FlakeExtent
{
    /// Smallest and largest coordinates, m, of positions that are finite; lower > upper: there are none.
    Vec3f lower{infinity<float>(), infinity<float>(), infinity<float>()};
    Vec3f upper{-infinity<float>(), -infinity<float>(), -infinity<float>()};
    std::uint64_t rogue = 0;  ///< see is_rogue
};

/// Turbulence of so many standard deviations has blown up and is no wind: the mark of Bailey 2017 and
/// QES-Plume, there |u'| >= 10 sigma. Fair draws stay below 5.8.
inline constexpr double kRogueDeviations = 10;

/// Whether a flake's state is not finite, or its turbulence has run away. Nothing is done to such flakes:
/// they are counted, because there must be none.
SPINDRIFT_HD bool is_rogue(const FlakeView& f, std::size_t i)
{
    const Vec3f q{f.q1[i], f.q2[i], f.q3[i]};
    const float sum = f.x[i] + f.y[i] + f.z[i] + f.slip_x[i] + f.slip_y[i] + f.slip_z[i];
    const float square = fma(q.x, q.x, fma(q.y, q.y, q.z * q.z));
    // a NaN fails the comparison
    return !(is_finite(sum) && square < number<float>(kRogueDeviations * kRogueDeviations));
}

/// Takes in the flake of a slot, if it lives.
SPINDRIFT_HD void include(FlakeExtent& extent, const FlakeView& f, std::size_t i)
{
    if (!is_alive(f.state[i])) return;
    if (is_rogue(f, i)) ++extent.rogue;
    const Vec3f x{f.x[i], f.y[i], f.z[i]};
    if (!is_finite(x.x + x.y + x.z)) return;
    extent.lower = {min(x.x, extent.lower.x), min(x.y, extent.lower.y), min(x.z, extent.lower.z)};
    extent.upper = {max(x.x, extent.upper.x), max(x.y, extent.upper.y), max(x.z, extent.upper.z)};
}

SPINDRIFT_HD void include(FlakeExtent& extent, const FlakeExtent& other)
{
    const Vec3f &l = other.lower, &u = other.upper;
    extent.lower = {min(l.x, extent.lower.x), min(l.y, extent.lower.y), min(l.z, extent.lower.z)};
    extent.upper = {max(u.x, extent.upper.x), max(u.y, extent.upper.y), max(u.z, extent.upper.z)};
    extent.rogue += other.rogue;
}

}  // namespace spindrift
