// SPDX-License-Identifier: MIT
#pragma once

#include "core/light.h"
#include "core/math.h"
#include "core/vec.h"

namespace spindrift
{

// Tone curves: from exposed light (linear Rec.709, 1 is white, no upper end) to the display's linear light in
// [0, 1], before sRGB. shaders/tone_curves.glsl mirrors them; a test holds the two together.

enum class ToneCurve
{
    linear,      ///< clamped at white
    reinhard,    ///< extended Reinhard on luminance
    aces,        ///< Hill's fit of the ACES RRT and ODT
    agx,         ///< AgX, the polynomial of its default contrast
    neutral,     ///< Khronos PBR Neutral: one to one below 0.8, no shift of hue
    calibrated,  ///< linear in cd/m2 of a display
    legacy,      ///< the constant gain that came of evaluating Reinhard's curve at the exposure
};

template <class R>
struct Tone
{
    ToneCurve curve = ToneCurve::linear;
    R white{4};  ///< reinhard: least luminance that becomes white
    R scale{1};  ///< linear, calibrated, legacy: display = scale x + offset
    R offset{0};
};

namespace detail
{

template <class R>
SPINDRIFT_HD Vec3<R> matrix(const Vec3<R>& c, const double (&m)[9])
{
    const auto row = [&](int i)
    { return number<R>(m[i]) * c.x + number<R>(m[i + 1]) * c.y + number<R>(m[i + 2]) * c.z; };
    return {row(0), row(3), row(6)};
}

template <class R, class F>
SPINDRIFT_HD Vec3<R> each(const Vec3<R>& c, const F& f)
{
    return {f(c.x), f(c.y), f(c.z)};
}

template <class R>
SPINDRIFT_HD Vec3<R> in_display(const Vec3<R>& c)
{
    return each(c, [](R v) { return clamp(v, number<R>(0), number<R>(1)); });
}

}  // namespace detail

/// L (1 + L / white²) / (1 + L): 1 at `white`. Source: Reinhard et al., Photographic tone reproduction for
/// digital images, SIGGRAPH 2002, eq. 4.
template <class R>
SPINDRIFT_HD R reinhard_extended(R luminance, R white)
{
    return luminance * (number<R>(1) + luminance / (white * white)) / (number<R>(1) + luminance);
}

/// Fit of the ACES reference and output transforms for Rec.709 displays, grey 0.18 to 0.106. Source: S. Hill,
/// in MJP's BakingLab (ACES.hlsl).
template <class R>
SPINDRIFT_HD Vec3<R> aces_fitted(const Vec3<R>& c)
{
    constexpr double in[9] = {0.59719, 0.35458, 0.04823, 0.07600, 0.90834,
                              0.01566, 0.02840, 0.13383, 0.83777};
    constexpr double out[9] = {1.60475,  -0.53108, -0.07367, -0.10208, 1.10813,
                               -0.00605, -0.00327, -0.07276, 1.07602};
    const Vec3<R> v = detail::matrix(c, in);
    const auto fit = [](R x)
    {
        return (x * (x + number<R>(0.0245786)) - number<R>(0.000090537)) /
               (x * (number<R>(0.983729) * x + number<R>(0.4329510)) + number<R>(0.238081));
    };
    return detail::in_display(detail::matrix(detail::each(v, fit), out));
}

/// AgX's sigmoid on a log2 axis from 0 (10 stops below 0.18) to 1 (6.5 above); display-encoded for a gamma of
/// 2.2. Source: T. Sobotka's AgX; the polynomial is B. Wrensch's ("Minimal AgX", mean square error 3.67e-6).
template <class R>
SPINDRIFT_HD R agx_contrast(R x)
{
    return polynomial(x, -0.00232, 0.1191, 0.4298, -6.868, 31.96, -40.14, 15.5);
}

template <class R>
SPINDRIFT_HD Vec3<R> agx(const Vec3<R>& c)
{
    constexpr double inset[9] = {0.842479062253094,  0.0784335999999992, 0.0792237451477643,
                                 0.0423282422610123, 0.878468636469772,  0.0791661274605434,
                                 0.0423756549057051, 0.0784336,          0.879142973793104};
    constexpr double outset[9] = {1.19687900512017,    -0.0980208811401368, -0.0990297440797205,
                                  -0.0528968517574562, 1.15190312990417,    -0.0989611768448433,
                                  -0.0529716355144438, -0.0980434501171241, 1.15107367264116};
    const auto encode = [](R v)
    {
        constexpr double least = -12.47393, most = 4.026069;
        const R stops = log2(max(v, number<R>(1e-10)));
        const R x = (stops - number<R>(least)) / number<R>(most - least);
        return agx_contrast(clamp(x, number<R>(0), number<R>(1)));
    };
    const auto decode = [](R v) { return pow(max(v, number<R>(0)), number<R>(2.2)); };
    const Vec3<R> look = detail::matrix(detail::each(detail::matrix(c, inset), encode), outset);
    return detail::in_display(detail::each(look, decode));
}

/// Khronos PBR Neutral. Takes off the 4 % that a dielectric reflects, is the identity from there to 0.76, and
/// compresses what is above towards white. Source: Khronos ToneMapping, PBR_Neutral (2024).
template <class R>
SPINDRIFT_HD Vec3<R> pbr_neutral(const Vec3<R>& c)
{
    const R start = number<R>(0.8 - 0.04);
    const R one = number<R>(1);
    const R least = min(c.x, min(c.y, c.z));
    const R off = select(least < number<R>(0.08), least - number<R>(6.25) * least * least, number<R>(0.04));
    const Vec3<R> base = c - Vec3<R>{off, off, off};
    const R peak = max(base.x, max(base.y, base.z));
    const R rest = one - start;
    const R above = max(peak - start, number<R>(0));
    const R new_peak = one - rest * rest / (above + rest);
    const R grey = one - one / (number<R>(0.15) * (above + start - min(new_peak, above + start)) + one);
    const Vec3<R> pressed = base * (new_peak / max(peak, start));
    const Vec3<R> toned = pressed * (one - grey) + Vec3<R>{new_peak, new_peak, new_peak} * grey;
    const auto high = peak >= start;
    return detail::in_display(
        Vec3<R>{select(high, toned.x, base.x), select(high, toned.y, base.y), select(high, toned.z, base.z)});
}

/// Display light of exposed light. Nothing of c may be negative or NaN (contained() of core/bloom.h sees to
/// it).
template <class R>
SPINDRIFT_HD Vec3<R> tone_mapped(const Vec3<R>& c, const Tone<R>& tone)
{
    switch (tone.curve)
    {
        case ToneCurve::reinhard:
        {
            const R y = max(luminance(c), number<R>(1e-30));
            return detail::in_display(c * (reinhard_extended(y, tone.white) / y));
        }
        case ToneCurve::aces:
            return aces_fitted(c);
        case ToneCurve::agx:
            return agx(c);
        case ToneCurve::neutral:
            return pbr_neutral(c);
        case ToneCurve::linear:
        case ToneCurve::calibrated:
        case ToneCurve::legacy:
            break;
    }
    return detail::in_display(c * tone.scale + Vec3<R>{tone.offset, tone.offset, tone.offset});
}

/// The tone of the report (Willemsen et al. 2011, section 3.6): exposure (exposure / max + 1) / (exposure +
/// 1) does not look at the pixel. As a factor on light that is exposed already.
SPINDRIFT_HD double legacy_gain(double exposure, double max_luminance)
{
    return (exposure / max_luminance + 1) / (exposure + 1);
}

/// Shows a luminance of `unit_cd_m2` times x as itself on a display that gives off `black` to `white` cd/m2.
SPINDRIFT_HD Tone<double> calibrated_tone(double unit_cd_m2, double white_cd_m2, double black_cd_m2)
{
    const double range = white_cd_m2 - black_cd_m2;
    return {ToneCurve::calibrated, 1, unit_cd_m2 / range, -black_cd_m2 / range};
}

/// IEC 61966-2-1; x in [0, 1].
template <class R>
SPINDRIFT_HD R srgb_encoded(R x)
{
    const R curve = number<R>(1.055) * pow(max(x, number<R>(1e-10)), number<R>(1 / 2.4)) - number<R>(0.055);
    return select(x <= number<R>(0.0031308), number<R>(12.92) * x, curve);
}

template <class R>
SPINDRIFT_HD R srgb_decoded(R v)
{
    const R curve = pow((v + number<R>(0.055)) / number<R>(1.055), number<R>(2.4));
    return select(v <= number<R>(0.04045), v / number<R>(12.92), curve);
}

}  // namespace spindrift
