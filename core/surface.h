// SPDX-License-Identifier: MIT
#pragma once

#include "core/math.h"
#include "core/vec.h"

namespace spindrift
{

// What shines of a surface: a Blinn-Phong lobe that gives back all light of a lamp overhead.
// shaders/scene.frag mirrors it. Source: Giesen, Phong and Blinn-Phong normalization factors (2009).

/// A material as the lobe sees it; colours are linear Rec.709.
template <class R>
struct Gloss
{
    Vec3<R> mirrored{};  ///< share of the light that is mirrored, seen and lit head on
    Vec3<R> matt{};      ///< albedo of the rest
    R exponent{0};
};

inline constexpr double kDielectric = 0.04;  ///< share that anything but metal mirrors

/// roughness in (0, 1): width of the lobe; at 1 a surface is matt and has none. metallic: share of bare
/// metal.
template <class R>
SPINDRIFT_HD Gloss<R> gloss_of(const Vec3<R>& albedo, const R& roughness, const R& metallic)
{
    const R other = number<R>(1) - metallic;
    const R base = number<R>(kDielectric) * other;
    const R least = max(roughness, number<R>(0.02));  // the exponent stays below 5000
    return {albedo * metallic + Vec3<R>{base, base, base}, albedo * other,
            number<R>(2) / (least * least) - number<R>(2)};
}

/// The lobe's height, 1/sr: its integral over the half space, times the cosine, is 1.
template <class R>
SPINDRIFT_HD R lobe_height(const R& exponent)
{
    const R two = number<R>(2), four = number<R>(4);
    return (exponent + two) * (exponent + four) /
           (number<R>(25.132741228718345) * (exp2(exponent / -two) + exponent));
}

/// Radiance towards `to_eye` per irradiance on a face towards the lamp; all vectors are units.
template <class R>
SPINDRIFT_HD R highlight(const R& exponent, const Vec3<R>& normal, const Vec3<R>& to_lamp,
                         const Vec3<R>& to_eye)
{
    const R zero = number<R>(0);
    const Vec3<R> sum = to_lamp + to_eye;
    const R length = max(sqrt(dot(sum, sum)), number<R>(1e-6));
    const R facing = max(dot(normal, sum) / length, zero);
    return lobe_height(exponent) * pow(facing, exponent) * max(dot(normal, to_lamp), zero);
}

}  // namespace spindrift
