// SPDX-License-Identifier: MIT
#pragma once

#include "core/math.h"
#include "core/vec.h"

namespace spindrift
{

// What a flake looks like on the picture, as docs/drawing.md says it under "Its sprite" and "Its light". R:
// double in the reference renderer, a pack of float where the processor blends; the shaders mirror the float
// form.

inline constexpr double kSmallestSprite_px = 0.75;  ///< radius; smaller ones are drawn at it, but fainter
inline constexpr double kLargestSprite_px = 127;    ///< radius; software GL ends there
inline constexpr double kDetailFrom_px = 3, kDetailWhole_px = 6;  ///< between them mask and imposter fade in
inline constexpr double kProfileSigma = 0.45;  ///< width of a flake's Gaussian in units of its radius
inline constexpr double kMostOpacity = 0.9999;
inline constexpr double kThinnestFade_m = 0.05;
inline constexpr double kMostRadiance = 6e4;  ///< a half float holds it
inline constexpr double kImposterDepth = 0.5;

template <class R>
struct SpriteSize
{
    R radius_px;  ///< as drawn
    R opacity;    ///< what smallness and nearness leave, before profile and weight
};

/// Of a flake of this radius at depth z.
template <class R>
SPINDRIFT_HD SpriteSize<R> sprite_size(const R& radius_m, const R& z, const R& focal_px, const R& largest_px,
                                       const R& near_m)
{
    const R one = number<R>(1);
    const R smallest = number<R>(kSmallestSprite_px);
    const R r = radius_m * focal_px / z;
    const R smaller = min(r / smallest, one);
    const R nearness = clamp((z - near_m) / (number<R>(3) * near_m), number<R>(0), one);
    return {clamp(r, smallest, largest_px), smaller * smaller * nearness};
}

/// Share of crystal mask and sphere imposter at a drawn radius (px).
template <class R>
SPINDRIFT_HD R sprite_detail(const R& radius_px)
{
    constexpr double width_px = kDetailWhole_px - kDetailFrom_px;
    return clamp((radius_px - number<R>(kDetailFrom_px)) * number<R>(1 / width_px), number<R>(0),
                 number<R>(1));
}

/// The Gaussian at a squared distance from the centre, in squared radii, at most 1.
template <class R>
SPINDRIFT_HD R sprite_profile(const R& rho2)
{
    constexpr double kLog2E = 1.44269504088896340736;
    return exp2_inside(rho2 * number<R>(-0.5 * kLog2E / (kProfileSigma * kProfileSigma)));
}

/// Factor on the lamps' light at the place (px, py) of the unit disc; towards: unit vector to the lamps
/// (right, up, towards the viewer), 0 without lamps.
template <class R>
SPINDRIFT_HD R imposter(const R& px, const R& py, const Vec3<R>& towards, const R& detail)
{
    const R one = number<R>(1);
    const R normal_z = sqrt(max(one - (px * px + py * py), number<R>(0)));
    const R facing = px * towards.x + py * towards.y + normal_z * towards.z;
    const R shade =
        (one + number<R>(kImposterDepth) * facing) / (one + number<R>(kImposterDepth * 2 / 3) * towards.z);
    return one + detail * (shade - one);
}

/// Opacity of one drawn flake that stands for several real ones.
template <class R>
SPINDRIFT_HD R weighted_opacity(const R& opacity, const R& real_flakes)
{
    const R one = number<R>(1);
    const R left = one - min(opacity, number<R>(kMostOpacity));
    return one - exp2_inside(max(real_flakes * detail::log2_inside(left), number<R>(-126)));
}

/// Share that is left where a flake cuts into the scene; 0 behind it.
template <class R>
SPINDRIFT_HD R soft_edge(const R& scene_z, const R& z, const R& per_m)
{
    return clamp((scene_z - z) * per_m, number<R>(0), number<R>(1));
}

/// Share of a flake in what all flakes of a pixel cover, where they are not sorted: what evenly spread flakes
/// let through up to there, so that the mean over many is that of sorted ones.
template <class R>
SPINDRIFT_HD R unsorted_weight(const R& extinction_per_m, const R& distance_m)
{
    constexpr double kLog2E = 1.44269504088896340736;
    constexpr double kLeast = -30;  // of its logarithm: sums keep their accuracy
    return exp2_inside(max(extinction_per_m * distance_m * number<R>(-kLog2E), number<R>(kLeast)));
}

/// In (0, 1), for a flake (32 random bits of its own) and a pixel, for ever the same. A sample s of n is
/// covered by the flake if the fraction of this plus s / n is below its alpha: so many are as alpha asks for,
/// and which ones is independent from flake to flake.
template <class R>
SPINDRIFT_HD R grain(const UIntOf<R>& flake, const UIntOf<R>& x, const UIntOf<R>& y)
{
    using UInt = UIntOf<R>;
    UInt h = flake + x * UInt(0x9E3779B9U) + y * UInt(0x85EBCA6BU);
    h = (h ^ (h >> 16)) * UInt(0x7FEB352DU);
    h = (h ^ (h >> 15)) * UInt(0x846CA68BU);
    h = h ^ (h >> 16);
    return (to_real<R>(as_int(h >> 8)) + number<R>(0.5)) * number<R>(0x1p-24);
}

}  // namespace spindrift
