// SPDX-License-Identifier: MIT
#pragma once

#include "core/math.h"
#include "core/phase.h"
#include "core/vec.h"

namespace spindrift
{

// Lamps and what flakes make of their light, as docs/drawing.md says it. Colours are linear Rec.709 in the
// order x = red, y = green, z = blue. R: double in the reference renderer; the shaders mirror the float form.

inline constexpr double kNearestLight_m = 0.05;  ///< lamps count as at least this far away
inline constexpr double kNarrowestCone = 0.001;  ///< least difference of the cosines of a spot's cones

enum class LampKind
{
    point,
    spot,
    directional,
};

/// A lamp in the local frame.
template <class R>
struct Lamp
{
    LampKind kind = LampKind::point;
    Vec3<R> position_m{};
    Vec3<R> direction{R(0), R(0), R(-1)};  ///< unit; the way the light travels (spot, directional)
    Vec3<R> intensity{};                   ///< point, spot: W/sr; directional: irradiance in W/m2
    R range_m = infinity<R>();
    R cos_inner{1}, cos_outer{0};  ///< of the half angles of the spot's cones
    Phase<R> phase;                ///< of flakes in this light
    bool casts_shadow = false;
};

/// Whether a flashing lamp is on at a moment: frac(t rate + phase) < duty.
SPINDRIFT_HD bool flash_is_on(double time_s, double rate_hz, double duty, double phase)
{
    const double periods = time_s * rate_hz + phase;
    return periods - floor(periods) < duty;
}

/// A lamp's light at a place.
template <class R>
struct LampLight
{
    Vec3<R> irradiance;  ///< W/m2 on a surface that faces the lamp
    Vec3<R> towards;     ///< unit vector from the place to the lamp
};

template <class R>
SPINDRIFT_HD LampLight<R> lamp_light(const Lamp<R>& lamp, const Vec3<R>& place)
{
    if (lamp.kind == LampKind::directional) return {lamp.intensity, lamp.direction * number<R>(-1)};
    const Vec3<R> way = lamp.position_m - place;
    const R distance = sqrt(dot(way, way));
    const Vec3<R> towards = way * (number<R>(1) / max(distance, number<R>(1e-6)));
    const R reach = distance / lamp.range_m;
    const R window = max(number<R>(1) - (reach * reach) * (reach * reach), number<R>(0));
    R share = number<R>(1);
    if (lamp.kind == LampKind::spot)
    {
        const R width = max(lamp.cos_inner - lamp.cos_outer, number<R>(kNarrowestCone));
        share = clamp((-dot(lamp.direction, towards) - lamp.cos_outer) / width, number<R>(0), number<R>(1));
        share = share * share;
    }
    const R away = max(distance, number<R>(kNearestLight_m));
    return {lamp.intensity * (share * window / (away * away)), towards};
}

/// Radiance that a flake sends towards `to_eye` (unit) of one lamp's light: phase function times irradiance.
template <class R>
SPINDRIFT_HD Vec3<R> scattered(const LampLight<R>& light, const Phase<R>& phase, const Vec3<R>& to_eye)
{
    const R mu = clamp(-dot(light.towards, to_eye), number<R>(-1), number<R>(1));
    return light.irradiance * scattered_share(phase, mu);
}

template <class R>
SPINDRIFT_HD R luminance(const Vec3<R>& colour)
{
    return number<R>(0.2126) * colour.x + number<R>(0.7152) * colour.y + number<R>(0.0722) * colour.z;
}

}  // namespace spindrift
