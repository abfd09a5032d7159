// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/drift.h"
#include "core/philox.h"
#include "core/world.h"

namespace spindrift
{

// What snow is made of: size spectra, fall speeds and masses, all from a flake's id. docs/physics.md "Flakes"
// gives the sources. Diameters: melted D_m (of the drop that a flake melts to) and flake D (largest
// dimension), mm in formulas, m outside.

inline constexpr double kFlakeDensity =
    0.17;  ///< g/cm3 times D in mm: density of a flake is 0.17 / D (Holroyd)
inline constexpr double kSmallestFlake_mm = 0.2;
inline constexpr double kLargestFlake_mm = 20;
inline constexpr double kLeastSnowRate_mm_h = 1e-3;  ///< spectra are not defined at 0
inline constexpr double kLeastFallSpeed_m_s = 0.05;

/// Exponential spectrum of melted diameters N(D_m) = intercept · exp(-slope D_m).
struct SizeLaw
{
    double intercept;  ///< N0, 1/(m3 mm)
    double slope;      ///< Lambda, 1/mm
};

/// Gunn and Marshall 1958, Sekhon and Srivastava 1970; rate in mm/h of water.
SPINDRIFT_HD SizeLaw size_law(SizeSpectrum spectrum, double rate_mm_h)
{
    const double rate = max(rate_mm_h, kLeastSnowRate_mm_h);
    if (spectrum == SizeSpectrum::sekhon_srivastava)
        return {2.5e3 * pow(rate, -0.94), 2.29 * pow(rate, -0.45)};
    return {3.8e3 * pow(rate, -0.87), 2.55 * pow(rate, -0.48)};
}

/// Real flakes per cubic metre of falling snow: N0 / Lambda.
SPINDRIFT_HD double flakes_per_m3(SizeSpectrum spectrum, double rate_mm_h)
{
    const SizeLaw law = size_law(spectrum, rate_mm_h);
    return law.intercept / law.slope;
}

/// Snow::weight with which `drawn` flakes in a volume stand for falling snow of this rate.
SPINDRIFT_HD double weight_of_drawn(SizeSpectrum spectrum, double rate_mm_h, double volume_m3, double drawn)
{
    return flakes_per_m3(spectrum, rate_mm_h) * volume_m3 / drawn;
}

/// Water in the air as snow, g/m3: pi rho_w N0 / Lambda^4.
SPINDRIFT_HD double water_content_g_m3(SizeSpectrum spectrum, double rate_mm_h)
{
    const SizeLaw law = size_law(spectrum, rate_mm_h);
    const double s2 = law.slope * law.slope;
    return 3.14159265358979323846e-3 * law.intercept / (s2 * s2);
}

/// Extinction by geometric optics, 1/km: Q_ext = 2, flakes of density 0.17 / D. Visibility (2 %) is 3.912 /
/// it; measured ones differ by a factor of 2 either way.
SPINDRIFT_HD double extinction_per_km(SizeSpectrum spectrum, double rate_mm_h)
{
    return 3.0 / kFlakeDensity * water_content_g_m3(spectrum, rate_mm_h);
}

/// Mean of pi D^2 / 4 over the flakes, m2: D^2 = D_m^3 / 0.17, <D_m^3> = 6 / Lambda^3.
SPINDRIFT_HD double mean_cross_section_m2(SizeSpectrum spectrum, double rate_mm_h)
{
    const SizeLaw law = size_law(spectrum, rate_mm_h);
    return 3.14159265358979323846e-6 * 1.5 / (kFlakeDensity * law.slope * law.slope * law.slope);
}

/// Terminal speed v = factor · D^power, D in mm, v in m/s. Locatelli and Hobbs 1974.
struct FallLaw
{
    double factor, power;
};

SPINDRIFT_HD FallLaw fall_law(Crystal crystal)
{
    switch (crystal)
    {
        case Crystal::plates:
            return {0.69, 0.41};
        case Crystal::rimed:
            return {0.62, 0.33};
        case Crystal::graupel:
            return {1.3, 0.66};
        case Crystal::dendrites:
            break;
    }
    return {0.8, 0.16};
}

/// What a hash of the id is for; the shaders count the same (docs/drawing.md).
enum class Trait : std::uint32_t
{
    size = 0,
    shape = 1,
    angle = 2,
    spin = 3,
    fall_speed = 4,
};

/// What all traits of a flake are hashed from.
template <class UInt>
SPINDRIFT_HD UInt flake_base(std::uint64_t seed, UInt id)
{
    return mix32(id ^ UInt(static_cast<std::uint32_t>(seed)));
}

template <class UInt>
SPINDRIFT_HD UInt flake_trait(UInt base, Trait trait)
{
    return mix32(base + UInt(static_cast<std::uint32_t>(trait) * 0x9E3779B9U));
}

/// 32 random bits of one trait of a flake, for ever the same.
template <class UInt>
SPINDRIFT_HD UInt trait_hash(std::uint64_t seed, UInt id, Trait trait)
{
    return flake_trait(flake_base(seed, id), trait);
}

/// In (0, 1); float rounds the topmost value to 1.
template <class R>
SPINDRIFT_HD R trait_uniform(UIntOf<R> hash)
{
    return (to_real<R>(as_int(hash >> 8)) + number<R>(0.5)) * number<R>(0x1p-24);
}

/// Normal-like with mean 0 and standard deviation exactly 1, within ±3.46: the sum of the four bytes
/// (Irwin-Hall).
template <class R>
SPINDRIFT_HD R trait_deviation(UIntOf<R> hash)
{
    using UInt = UIntOf<R>;
    const UInt byte(0xFFU);
    const UInt sum = (hash & byte) + ((hash >> 8) & byte) + ((hash >> 16) & byte) + (hash >> 24);
    // four independent bytes: mean 4 · 127.5, variance 4 (256² - 1) / 12
    return (to_real<R>(as_int(sum)) - number<R>(510)) * number<R>(1.0 / 147.80054127099805);
}

/// Sizes of the flakes of a run, from their ids by the inverse of the exponential distribution.
struct FlakeSizes
{
    double slope_per_mm = 1;
    std::uint64_t seed = 0;

    FlakeSizes() = default;
    SPINDRIFT_HD FlakeSizes(const Snow& snow, std::uint64_t run_seed)
        : slope_per_mm(size_law(snow.spectrum, static_cast<double>(snow.rate_mm_h)).slope), seed(run_seed)
    {
    }

    template <class R>
    SPINDRIFT_HD R melted_diameter_mm(UIntOf<R> id) const
    {
        const R u = trait_uniform<R>(trait_hash(seed, id, Trait::size));
        return -log(u) * number<R>(1.0 / slope_per_mm);
    }

    /// D = sqrt(D_m³ / 0.17), within [0.2, 20] mm.
    template <class R>
    SPINDRIFT_HD R diameter_m(UIntOf<R> id) const
    {
        const R melted = melted_diameter_mm<R>(id);
        const R flake = sqrt(melted * melted * melted * number<R>(1.0 / kFlakeDensity));
        return clamp(flake, number<R>(kSmallestFlake_mm), number<R>(kLargestFlake_mm)) * number<R>(1e-3);
    }

    /// Of the water that the flake melts to.
    template <class R>
    SPINDRIFT_HD R mass_kg(UIntOf<R> id) const
    {
        const R melted = melted_diameter_mm<R>(id) * number<R>(1e-3);
        return number<R>(3.14159265358979323846 / 6.0 * 1000.0) * (melted * melted * melted);
    }
};

/// Terminal speeds of the flakes of a run: the law of their crystal plus a deviation between flakes of one
/// size.
struct FallSpeed
{
    std::uint64_t seed = 0;
    float slope_per_mm = 1;
    float factor = 1;  ///< m/s at 1 mm
    float power = 0;
    float spread_m_s = 0;
    std::int32_t first_drift = 256;  ///< number of the first emitter of grains; 256: there is none
    GrainSpeed grains;
    float least_m_s = static_cast<float>(kLeastFallSpeed_m_s);

    FallSpeed() = default;
    SPINDRIFT_HD FallSpeed(const Snow& snow, std::uint64_t run_seed)
        : seed(run_seed),
          slope_per_mm(
              static_cast<float>(size_law(snow.spectrum, static_cast<double>(snow.rate_mm_h)).slope)),
          factor(static_cast<float>(fall_law(snow.crystal).factor)),
          power(static_cast<float>(fall_law(snow.crystal).power)),
          spread_m_s(snow.fall_speed_spread_m_s)
    {
        if (!(snow.fall_speed_m_s >= 0)) return;
        factor = snow.fall_speed_m_s, power = 0;
        least_m_s = min(least_m_s, snow.fall_speed_m_s);
    }

    /// Of a flake with this state (core/flake.h): a grain of drift, or a flake.
    template <class R>
    SPINDRIFT_HD R at(UIntOf<R> id, UIntOf<R> state) const
    {
        const R flake = at<R>(id);
        if (first_drift > 255) return flake;
        const R grain = grains.at(trait_deviation<R>(trait_hash(seed, id, Trait::fall_speed)));
        const auto emitter = as_int((state >> 8) & UIntOf<R>(0xFFU));
        return select(emitter < IntOf<R>(first_drift), flake, grain);
    }

    /// m/s, downwards, at least 0.05 unless all are to fall more slowly. The diameter stays a logarithm: D =
    /// 2^d, d = (3 log2 D_m - log2 0.17) / 2.
    template <class R>
    SPINDRIFT_HD R at(UIntOf<R> id) const
    {
        const R u = trait_uniform<R>(trait_hash(seed, id, Trait::size));
        const R melted = log(u) / number<R>(-slope_per_mm);
        const R d = fma(number<R>(1.5), log2(melted), number<R>(1.27819667395532));
        const R inside = clamp(d, number<R>(-2.32192809488736), number<R>(4.32192809488736));
        const R speed = number<R>(factor) * exp2(number<R>(power) * inside);
        const R deviation = trait_deviation<R>(trait_hash(seed, id, Trait::fall_speed));
        return max(fma(number<R>(spread_m_s), deviation, speed), number<R>(least_m_s));
    }
};

/// How a flake is turned and shaped.
struct FlakeTurn
{
    std::uint32_t shape;  ///< which of `shapes` crystals
    double angle_turns;   ///< at t = 0
    double spin_turns_per_s;

    SPINDRIFT_HD double turns_at(double time_s) const { return angle_turns + spin_turns_per_s * time_s; }
};

SPINDRIFT_HD FlakeTurn flake_turn(std::uint64_t seed, std::uint32_t id, std::uint32_t shapes)
{
    return {trait_hash(seed, id, Trait::shape) % shapes,
            trait_uniform<double>(trait_hash(seed, id, Trait::angle)),
            trait_uniform<double>(trait_hash(seed, id, Trait::spin)) - 0.5};
}

}  // namespace spindrift
