// SPDX-License-Identifier: MIT
#pragma once

#include "core/math.h"
#include "core/snow.h"
#include "core/world.h"

namespace spindrift
{

// How thick the air is. The one quantity is the extinction beta in 1/m: contrast after d metres is exp(-beta
// d) (Koschmieder). Everything that people call visibility is turned into it here. R: float or double.

/// What is left of a black thing's contrast at the visibility.
enum class VisibilityContrast
{
    five_percent,  ///< meteorological optical range (WMO, OSI): beta = 2.996 / V
    two_percent,   ///< Koschmieder's threshold: beta = 3.912 / V
};

template <class R>
SPINDRIFT_HD R optical_depth_at_visibility(VisibilityContrast contrast)
{
    return number<R>(contrast == VisibilityContrast::five_percent ? 2.99573227355399099
                                                                  : 3.91202300542814606);
}

template <class R>
SPINDRIFT_HD R extinction_of_visibility(const R& visibility_m, VisibilityContrast contrast)
{
    return optical_depth_at_visibility<R>(contrast) / visibility_m;
}

/// Infinite in clear air.
template <class R>
SPINDRIFT_HD R visibility_of_extinction(const R& per_m, VisibilityContrast contrast)
{
    return optical_depth_at_visibility<R>(contrast) / per_m;
}

/// 1/m of air that holds `g_m3` of snow: beta = 10.36 C^0.7776 per km. Stallabrass 1985, as Stoelinga and
/// Warner (J. Appl. Meteor. 38, 1999) use it. Measurements differ from it by a factor of 2 either way.
template <class R>
SPINDRIFT_HD R extinction_of_concentration(const R& g_m3)
{
    return number<R>(10.36e-3) * pow(g_m3, number<R>(0.7776));
}

/// Snow in the air, g/m3, that falls as `rate_mm_h` of water at `speed_m_s`.
template <class R>
SPINDRIFT_HD R concentration_of_snowfall(const R& rate_mm_h, const R& speed_m_s)
{
    return rate_mm_h / (number<R>(3.6) * speed_m_s);
}

/// Mean fall speed, weighted with mass, of crystals of a spectrum: v = a D^b over N0 exp(-Lambda D_m) with D
/// = sqrt(D_m³ / 0.17) gives a 0.17^(-b/2) Lambda^(-1.5 b) Gamma(4 + 1.5 b) / Gamma(4). m/s.
SPINDRIFT_HD double mean_fall_speed(const Snow& snow)
{
    if (snow.fall_speed_m_s >= 0)
        return max(static_cast<double>(snow.fall_speed_m_s), kLeastFallSpeed_m_s);  // no endless extinction
    const FallLaw law = fall_law(snow.crystal);
    // Gamma(4 + 1.5 b) / Gamma(4) in the order of Crystal; tests/core/visibility_test.cpp computes them
    constexpr double kGammas[] = {1.3626943694883387, 2.278065383637709, 1.9252115490837776,
                                  3.9402503374840365};
    const double gammas = kGammas[static_cast<int>(snow.crystal)];
    const double slope = size_law(snow.spectrum, static_cast<double>(snow.rate_mm_h)).slope;
    return law.factor * pow(kFlakeDensity, -0.5 * law.power) * pow(slope, -1.5 * law.power) * gammas;
}

/// 1/m of a snowfall by its rate and crystals: slow crystals hang denser in the air.
SPINDRIFT_HD double extinction_of_snowfall(const Snow& snow)
{
    return extinction_of_concentration(
        concentration_of_snowfall(static_cast<double>(snow.rate_mm_h), mean_fall_speed(snow)));
}

// The report's experiment (CTS 11-04, section 3.5): particles per second past a black rectangle, its mean
// grey from 0 to 255, and the visibility that follows as a share of 600 m.

inline constexpr double kReportFarthest_m = 600;
inline constexpr double kReportNearest_m = 1;        ///< what clamping leaves: no division by 0
inline constexpr double kReportPeak_per_s = 726202;  ///< from where on the printed fit falls again

/// The report's fit 325.5 exp(-2.3e-7 x) - 318.5 exp(-4.2e-6 x), clamped: held beyond its peak and within 0
/// to 255. It is 7 at 0, 18 grey levels off its own table at worst, and would exceed 255 from 547 000/s.
template <class R>
SPINDRIFT_HD R report_grey(const R& particles_per_s)
{
    const R x = clamp(particles_per_s, number<R>(0), number<R>(kReportPeak_per_s));
    const R fit =
        number<R>(325.5) * exp(number<R>(-2.3e-7) * x) - number<R>(318.5) * exp(number<R>(-4.2e-6) * x);
    return clamp(fit, number<R>(0), number<R>(255));
}

/// The same table by one parameter: particles that cover the rectangle independently of one another leave
/// exp(-k x) of it black.
inline constexpr double kReportCover_s = 6.38e-6;
template <class R>
SPINDRIFT_HD R cover_grey(const R& particles_per_s, const R& cover_s)
{
    return number<R>(255) * (number<R>(1) - exp(-cover_s * particles_per_s));
}

/// The report's visibility (1 - grey / 255) 600 m, at least 1 m.
template <class R>
SPINDRIFT_HD R report_visibility_m(const R& grey)
{
    const R share = number<R>(1) - grey * number<R>(1.0 / 255);
    return max(share * number<R>(kReportFarthest_m), number<R>(kReportNearest_m));
}

/// The report's aggregate snow: share of an object's own colour that is left beyond the flakes' volume, its
/// visibility (0 to 1) minus distance over 600 m, clamped to 0 to 1.
template <class R>
SPINDRIFT_HD R report_transmittance(const R& visibility_share, const R& beyond_m)
{
    return clamp(visibility_share - beyond_m * number<R>(1 / kReportFarthest_m), number<R>(0), number<R>(1));
}

}  // namespace spindrift
