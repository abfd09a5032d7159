// SPDX-License-Identifier: MIT
#pragma once

#include "core/math.h"
#include "core/number.h"
#include "core/turbulence.h"

namespace spindrift
{

// Snow that the wind takes up from the ground (docs/physics.md "Blowing snow"). u*: friction velocity of the
// wind, u*t: the one at which snow begins to move.

inline constexpr double kAirDensity_kg_m3 = 1.2;
inline constexpr double kIceDensity_kg_m3 = 917;

/// The layer in which grains leap along the ground.
struct Saltation
{
    double flux_kg_m_s = 0;  ///< along the wind, per metre across it
    double height_m = 0;
    double snow_kg_m3 = 0;
};

/// Pomeroy and Gray 1990; nothing moves at u* <= u*t.
SPINDRIFT_HD Saltation saltation(double friction_m_s, double threshold_m_s)
{
    if (!(friction_m_s > threshold_m_s && threshold_m_s > 0)) return {};
    Saltation s;
    s.flux_kg_m_s = 0.68 * kAirDensity_kg_m3 / 9.80665 * (threshold_m_s / friction_m_s) *
                    (friction_m_s * friction_m_s - threshold_m_s * threshold_m_s);
    s.height_m = 0.08436 * pow(friction_m_s, 1.27);
    s.snow_kg_m3 = s.flux_kg_m_s / (2.8 * threshold_m_s * s.height_m);
    return s;
}

/// Radii of grains at a height: a gamma distribution (Pomeroy and Male 1992).
struct GrainLaw
{
    double shape = 1;
    double scale_m = 0;  ///< mean radius over shape
};

SPINDRIFT_HD GrainLaw grain_law(double height_m)
{
    const double shape = min(4.08 + 12.6 * height_m, 25.0);
    return {shape, max(4.6e-5 * pow(height_m, -0.258), 3e-5) / shape};
}

/// ln Gamma(x) for x of at least 3, by Stirling's series: relative error below 1e-5.
SPINDRIFT_HD double log_gamma(double x)
{
    return (x - 0.5) * log(x) - x + 0.91893853320467274178 + 1 / (12 * x) - 1 / (360 * x * x * x);
}

/// Mean of r^power, m^power.
SPINDRIFT_HD double grain_moment(const GrainLaw& law, double power)
{
    return pow(law.scale_m, power) * exp(log_gamma(law.shape + power) - log_gamma(law.shape));
}

/// Terminal speed of a grain is kGrainFall r^kGrainPower, m/s (Pomeroy and Male 1992).
inline constexpr double kGrainFall = 1.1e7, kGrainPower = 1.8;

/// Cross-section of the grains that leave a square metre of ground in a second, 1/s: as much as falls back to
/// it where the layer of saltation is full.
SPINDRIFT_HD double lifted_per_s(const Saltation& layer, const GrainLaw& law)
{
    constexpr double kPi = 3.14159265358979323846;
    const double grains_m3 =
        layer.snow_kg_m3 / (kIceDensity_kg_m3 * (4.0 / 3.0) * kPi * grain_moment(law, 3));
    return grains_m3 * kPi * kGrainFall * grain_moment(law, 2 + kGrainPower);
}

/// The radii of what leaves the ground, by their cross-section.
SPINDRIFT_HD GrainLaw lifted_law(const GrainLaw& law)
{
    return {law.shape + 2 + kGrainPower, law.scale_m};
}

/// K_zz = kLiftPerFriction u* z in the neutral surface layer of core/turbulence.h: 2 (tau^2)_zz / C0 eps.
inline constexpr double kLiftPerFriction =
    2 * (1 + kSigmaUp * kSigmaUp * kSigmaUp * kSigmaUp) * kVonKarman / kKolmogorovC0;

/// Height at which a share of the suspended grains of one speed lies below: they are as dense as z^(-w / b),
/// b = K_zz / z (Rouse 1937), from `low` to `high`.
template <class R>
SPINDRIFT_HD R suspended_height(const R& fall, const R& lift, const R& low, const R& high, const R& share)
{
    const R one = number<R>(1.0);
    R power = one - fall / lift;
    power = select(abs(power) < number<R>(1e-3), number<R>(1e-3), power);  // the limit is a logarithm
    power = max(power, number<R>(-60.0));
    const R ratio = pow(high / low, power);
    return clamp(low * pow(fma(share, ratio - one, one), one / power), low, high);
}

/// Fall speeds of drifting grains from the deviation of a flake (snow.h): radii by Wilson and Hilferty's cube
/// of a normal deviate.
struct GrainSpeed
{
    float factor_m_s = 0;  ///< at shape * scale
    float centre = 1, width = 0;

    GrainSpeed() = default;
    SPINDRIFT_HD explicit GrainSpeed(const GrainLaw& law)
        : factor_m_s(static_cast<float>(kGrainFall * pow(law.shape * law.scale_m, kGrainPower))),
          centre(static_cast<float>(1 - 1 / (9 * law.shape))),
          width(static_cast<float>(1 / (3 * sqrt(law.shape))))
    {
    }

    template <class R>
    SPINDRIFT_HD R at(const R& deviation) const
    {
        const R root = max(fma(number<R>(width), deviation, number<R>(centre)), number<R>(0.01));
        return number<R>(factor_m_s) * pow(root, number<R>(3 * kGrainPower));
    }
};

}  // namespace spindrift
