// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "core/math.h"
#include "core/vec.h"

namespace spindrift
{

// Snow-filled air as a medium: how much of it hides what lies behind. Its extinction is a uniform part (the
// snowfall) plus a drift that thins out upwards. Where drawn flakes already hide as much as the snowfall
// should, fog must not hide it again: fog = total - flakes, at every point, so that flakes and fog together
// let exp(-beta d) through. docs/drawing.md "Air". R: double in the reference
// renderer, a pack of float where the processor blends; the shaders mirror it. Lengths in m, local frame.

/// Extinction of all snow in the air.
template <class R>
struct AirLayers
{
    R uniform_per_m{0};
    R drift_per_m{0};     ///< at and below drift_base_m
    R drift_height_m{1};  ///< over which the drift falls to 1/e
    R drift_base_m{0};
};

template <class R>
SPINDRIFT_HD R extinction_at(const AirLayers<R>& air, const R& height_m)
{
    const R above = max(height_m - air.drift_base_m, number<R>(0)) / air.drift_height_m;
    return air.uniform_per_m + air.drift_per_m * exp(-above);
}

/// Mean of the drift's profile, exp(-max(h - base, 0) / scale), between two heights.
template <class R>
SPINDRIFT_HD R mean_drift(const AirLayers<R>& air, const R& from_m, const R& to_m)
{
    const R zero = number<R>(0), one = number<R>(1);
    const R a = (from_m - air.drift_base_m) / air.drift_height_m;
    const R b = (to_m - air.drift_base_m) / air.drift_height_m;
    const R change = b - a;
    const auto level = abs(change) < number<R>(1e-2);
    // antiderivative: u below the base, 1 - exp(-u) above it
    const R low = min(a, zero) + (one - exp(-max(a, zero)));
    const R high = min(b, zero) + (one - exp(-max(b, zero)));
    const R middle = exp(-max(number<R>(0.5) * (a + b), zero));
    return select(level, middle, (high - low) / select(level, one, change));
}

/// Optical depth of all snow on a straight way of `length_m` between two heights.
template <class R>
SPINDRIFT_HD R optical_depth(const AirLayers<R>& air, const R& from_m, const R& to_m, const R& length_m)
{
    return length_m * (air.uniform_per_m + air.drift_per_m * mean_drift(air, from_m, to_m));
}

/// Share of a flake's opacity that is left on the picture where fog stands for the rest: none below a sixth
/// of a pixel across, all from a third of a pixel on.
template <class R>
SPINDRIFT_HD R kept_of_tiny(const R& diameter_px)
{
    return clamp(number<R>(6) * diameter_px - number<R>(1), number<R>(0), number<R>(1));
}

/// What a drawn flake hides, by its depth along the view, whatever its size: the mean over the spectrum.
/// Entries stand at equal steps of log2 of the depth.
template <class R>
struct FlakeShade
{
    using Entry = std::conditional_t<NumberTraits<R>::is_double, double, float>;

    const Entry* area_m2 = nullptr;      ///< at the entries' depths
    const Entry* integral_m3 = nullptr;  ///< of the area from depth 0 to the entries' depths
    int entries = 0;                     ///< fewer than 2: flakes hide nothing
    Entry first_log2 = 0;  ///< log2 of the first entry's depth in m; nearer flakes are not drawn
    Entry entries_per_log2 = 1;

    SPINDRIFT_HD R area_at(const R& depth_m) const { return between(area_m2, depth_m); }
    SPINDRIFT_HD R integral_to(const R& depth_m) const { return between(integral_m3, depth_m); }

  private:
    SPINDRIFT_HD R between(const Entry* values, const R& depth_m) const
    {
        if (entries < 2) return number<R>(0);
        const R at = (log2(max(depth_m, number<R>(1e-6))) - R(first_log2)) * R(entries_per_log2);
        const R inside = clamp(at, number<R>(0), number<R>(entries - 1));
        const R low = min(floor(inside), number<R>(entries - 2));
        const auto index = truncate_to_int(low);
        const R left = gather(values, index), right = gather(values, index + IntOf<R>(1));
        return left + (right - left) * (inside - low);
    }
};

/// The box in which flakes are drawn, evenly. None: flakes_per_m3 = 0.
template <class R>
struct FlakeVolume
{
    Vec3<R> low{}, high{};
    R flakes_per_m3{0};
    FlakeShade<R> shade;
};

/// A straight way from the eye through the air.
template <class R>
struct AirPath
{
    AirLayers<R> air;
    FlakeVolume<R> volume;
    Vec3<R> eye{}, way{};        ///< way: unit
    R cosine{1};                 ///< of the way to the view's forward
    R enters_m{0}, leaves_m{0};  ///< the flakes' volume, along the way; equal: missed

    SPINDRIFT_HD AirPath(const AirLayers<R>& layers, const FlakeVolume<R>& flakes, const Vec3<R>& from,
                         const Vec3<R>& unit_way, const R& forward_cosine)
        : air(layers), volume(flakes), eye(from), way(unit_way), cosine(forward_cosine)
    {
        R enter = number<R>(0), leave = infinity<R>();
        cut(eye.x, way.x, volume.low.x, volume.high.x, enter, leave);
        cut(eye.y, way.y, volume.low.y, volume.high.y, enter, leave);
        cut(eye.z, way.z, volume.low.z, volume.high.z, enter, leave);
        const auto drawn = volume.flakes_per_m3 > number<R>(0);
        enters_m = select(drawn, enter, number<R>(0));
        leaves_m = select(drawn, max(enter, leave), number<R>(0));
    }

    /// Optical depth of the drawn flakes up to `to_m`: what they hide on average. Sprites are discs on the
    /// picture, not on the way to them: what they hide goes by depth, so towards the picture's corners less
    /// than spheres would.
    SPINDRIFT_HD R of_flakes(const R& to_m) const
    {
        const R from = min(enters_m, to_m) * cosine, to = min(leaves_m, to_m) * cosine;
        return volume.flakes_per_m3 * (volume.shade.integral_to(to) - volume.shade.integral_to(from));
    }

    SPINDRIFT_HD R of_all(const R& to_m) const
    {
        return optical_depth(air, eye.z, eye.z + way.z * to_m, to_m);
    }

    /// Optical depth that is left to the fog.
    SPINDRIFT_HD R of_fog(const R& to_m) const { return max(of_all(to_m) - of_flakes(to_m), number<R>(0)); }

    /// Extinction of the fog there, 1/m.
    SPINDRIFT_HD R fog_at(const R& at_m) const
    {
        const auto inside = at_m > enters_m && at_m < leaves_m;
        const R flakes = volume.flakes_per_m3 * volume.shade.area_at(at_m * cosine) * cosine;
        return max(extinction_at(air, eye.z + way.z * at_m) - select(inside, flakes, number<R>(0)),
                   number<R>(0));
    }

  private:
    static SPINDRIFT_HD void cut(const R& from, const R& along, const R& low, const R& high, R& enter,
                                 R& leave)
    {
        const auto parallel = abs(along) < number<R>(1e-9);  // in between for ever, or never
        const auto out = from < low || from > high;
        const R inverse = number<R>(1) / select(parallel, number<R>(1), along);
        const R a = (low - from) * inverse, b = (high - from) * inverse;
        enter = select(parallel, enter, max(enter, min(a, b)));
        leave = select(parallel, select(out, number<R>(-1), leave), min(leave, max(a, b)));
    }
};

}  // namespace spindrift
