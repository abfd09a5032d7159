// SPDX-License-Identifier: MIT
#pragma once

#include "core/math.h"
#include "core/sprite.h"
#include "core/vec.h"

namespace spindrift
{

// A flake that moves while the shutter is open: the mean over that time of its opacity at each place, docs/
// drawing.md "Streaks". Lengths in radii of its sprite. R: double in the reference renderer, a pack of float
// where the processor blends; the shaders mirror it.

inline constexpr double kShortestStreak = 0.05;  ///< half of its length; shorter ones are points
inline constexpr double kPlainStreak = 0.5;  ///< from here on crystal and imposter are blurred to their mean

/// The way of a sprite's centre: from -half to half along a unit vector, x to the right, y up.
template <class R>
struct Streak
{
    R along_x{1}, along_y{0}, half{0};
    R even{0};  ///< share of the plain disc in the profile, the rest is the Gaussian
};

/// How far the flake gets on the picture in half the time, px. `from_eye`, `velocity`: right, up, forward; m,
/// m/s.
template <class R>
SPINDRIFT_HD void streak_way(const Vec3<R>& from_eye, const Vec3<R>& velocity, const R& px_per_m,
                             const R& shutter_s, R& x_px, R& y_px)
{
    const R scale = number<R>(0.5) * shutter_s * px_per_m, closer = velocity.z / from_eye.z;
    x_px = (velocity.x - from_eye.x * closer) * scale;
    y_px = (velocity.y - from_eye.y * closer) * scale;
}

/// That way as a streak, cut so that the sprite with it stays within `largest_px`.
template <class R>
SPINDRIFT_HD Streak<R> streak_of(const R& x_px, const R& y_px, const R& radius_px, const R& largest_px)
{
    const R way = sqrt(x_px * x_px + y_px * y_px);
    const auto moves = way > number<R>(1e-9);
    const R inverse = number<R>(1) / select(moves, way, number<R>(1));
    const R half = min(way, largest_px - radius_px) / radius_px;
    Streak<R> streak;
    streak.along_x = select(moves, x_px * inverse, number<R>(1));
    streak.along_y = select(moves, y_px * inverse, number<R>(0));
    streak.half = select(half > number<R>(kShortestStreak), half, number<R>(0));
    return streak;
}

/// Integral of sprite_profile(t²) from 0 to x, |x| <= 1: its series, to 1e-8.
template <class R>
SPINDRIFT_HD R profile_integral(const R& x)
{
    constexpr double k = 0.5 / (kProfileSigma * kProfileSigma);
    constexpr int terms = 14;
    double factor[terms] = {1};
    for (int n = 1; n < terms; ++n) factor[n] = -k / n * factor[n - 1];
    const R x2 = x * x;
    R sum = number<R>(factor[terms - 1] / (2 * terms - 1));
    for (int n = terms - 2; n >= 0; --n) sum = fma(sum, x2, number<R>(factor[n] / (2 * n + 1)));
    return sum * x;
}

/// Mean over the way of the profile at a place (px, py), at most 1. `discs`: of the plain disc alone.
template <class R>
SPINDRIFT_HD R streak_profile(const Streak<R>& streak, const R& px, const R& py, bool discs)
{
    const R zero = number<R>(0), one = number<R>(1);
    const R s = px * streak.along_x + py * streak.along_y, q = py * streak.along_x - px * streak.along_y;
    const R q2 = min(q * q, one);
    const R chord = sqrt(one - q2);
    // In the place's own frame the centre passes from s - half to s + half; it counts within the chord.
    const R from = clamp(s - streak.half, -chord, chord), to = clamp(s + streak.half, -chord, chord);
    const R per_way = number<R>(0.5) / max(streak.half, number<R>(kShortestStreak));
    const R disc = (to - from) * per_way;
    if (discs) return disc;
    const R gauss = sprite_profile(q2) * (profile_integral(to) - profile_integral(from)) * per_way;
    return max(gauss + streak.even * (disc - gauss), zero);
}

/// Share of the plain disc with which a streak of opacity weighted_opacity(opacity, real_flakes) hides as
/// much as the flake at rest: the integral of the weighted Gaussian over the unit disc, by four
/// Gauss-Legendre points in rho², is that of (1 - share) Gaussian + share disc times its height.
template <class R>
SPINDRIFT_HD R even_share(const R& opacity, const R& real_flakes)
{
    constexpr double gauss = 0.37071351;  // (1 - exp(-k)) / k, k = 0.5 / kProfileSigma²
    constexpr double kPlaces[4] = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                   0.93056815579702629};
    constexpr double kWeights[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                    0.17392742256872693};
    R sum = number<R>(0);
    for (int i = 0; i < 4; ++i)
        sum = sum + number<R>(kWeights[i]) *
                        weighted_opacity(opacity * sprite_profile(number<R>(kPlaces[i])), real_flakes);
    const R height = max(weighted_opacity(opacity, real_flakes), number<R>(1e-12));
    return (sum / height - number<R>(gauss)) * number<R>(1 / (1 - gauss));
}

/// What is left of crystal and imposter.
template <class R>
SPINDRIFT_HD R streak_detail(const Streak<R>& streak)
{
    return max(number<R>(1) - streak.half * number<R>(1 / kPlainStreak), number<R>(0));
}

}  // namespace spindrift
