// SPDX-License-Identifier: MIT
#pragma once

#include "core/air.h"
#include "core/light.h"

namespace spindrift
{

// The glow of a lamp in the air between the eye and what it sees: light scattered once. With t along the way,
// t_c where it passes the lamp nearest, h that least distance and r the distance there, t = t_c + h
// tan(theta) turns the integral of phase · I / r² · extinction · transmittances into a smooth one over theta,
// as dt / r² = dtheta / h; eight Gauss-Legendre points then leave at most 0.5 % of error
// (tests/core/airlight_test.cpp). Equi-angular sampling: Kulla and Fajardo, Computer Graphics Forum 31
// (2012).

inline constexpr int kAirlightPoints = 8;
inline constexpr double kGauss8Place[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                           0.9602898564975363};
inline constexpr double kGauss8Weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                            0.1012285362903763};

/// The part of a way, in m, that a point or spot lamp reaches: its range and its cone. Empty: to <= from.
template <class R>
struct LitPart
{
    R from, to;
};

template <class R>
SPINDRIFT_HD LitPart<R> lit_part(const Lamp<R>& lamp, const Vec3<R>& eye, const Vec3<R>& way, R from, R to)
{
    const Vec3<R> away = eye - lamp.position_m;
    const R along = dot(away, way), far2 = dot(away, away);
    if (is_finite(lamp.range_m))
    {
        const R inside = lamp.range_m * lamp.range_m - (far2 - along * along);
        if (!(inside > R(0))) return {from, from};
        const R half = sqrt(inside);
        from = max(from, -along - half);
        to = min(to, half - along);
    }
    if (lamp.kind != LampKind::spot) return {from, to};
    // Inside the cone: u(t) = dot(direction, x) >= 0 and u² >= cos² |x|² with x = away + t way.
    const R cos2 = lamp.cos_outer * lamp.cos_outer;
    const R u0 = dot(lamp.direction, away), u1 = dot(lamp.direction, way);
    const R a = u1 * u1 - cos2, b = u0 * u1 - cos2 * along, c = u0 * u0 - cos2 * far2;
    const R determinant = b * b - a * c;
    if (abs(a) < R(1e-9))  // parallel to the cone's side
    {
        if (abs(b) < R(1e-9)) return c > R(0) && u0 > R(0) ? LitPart<R>{from, to} : LitPart<R>{from, from};
        const R at = c / (R(-2) * b);
        return b > R(0) ? LitPart<R>{max(from, at), to} : LitPart<R>{from, min(to, at)};
    }
    if (determinant < R(0)) return a > R(0) && u0 > R(0) ? LitPart<R>{from, to} : LitPart<R>{from, from};
    const R root = sqrt(determinant);
    const R first = min((-b - root) / a, (-b + root) / a), second = max((-b - root) / a, (-b + root) / a);
    if (a < R(0))  // enters and leaves one of the two cones that meet in the lamp
        return u0 + u1 * R(0.5) * (first + second) > R(0) ? LitPart<R>{max(from, first), min(to, second)}
                                                          : LitPart<R>{from, from};
    // runs from one of them into the other: the lamp's own is the one that the way turns to
    return u1 > R(0) ? LitPart<R>{max(from, second), to} : LitPart<R>{from, min(to, first)};
}

/// Radiance towards the eye, W/(m2 sr), of a point or spot lamp's light from the part [from, to] of a way.
/// The extinction must be smooth there: cut the way where it enters and leaves the flakes' volume.
template <class R>
SPINDRIFT_HD Vec3<R> airlight(const AirPath<R>& path, const Lamp<R>& lamp, const R& from_m, const R& to_m)
{
    const Vec3<R> nothing{R(0), R(0), R(0)};
    const LitPart<R> lit = lit_part(lamp, path.eye, path.way, from_m, to_m);
    if (!(lit.to > lit.from)) return nothing;
    const Vec3<R> to_lamp = lamp.position_m - path.eye;
    const R nearest = dot(to_lamp, path.way);
    const R least2 = dot(to_lamp, to_lamp) - nearest * nearest;
    const R least = sqrt(max(least2, R(kNearestLight_m * kNearestLight_m)));
    const R first = atan((lit.from - nearest) / least), last = atan((lit.to - nearest) / least);
    const R middle = R(0.5) * (first + last), half = R(0.5) * (last - first);
    R sum(0);
    for (int k = 0; k < kAirlightPoints; ++k)
    {
        const R place = R(k < 4 ? -kGauss8Place[k] : kGauss8Place[k - 4]);
        R sine, cosine;
        sincos_turns((middle + half * place) * R(0.15915494309189533577), sine, cosine);
        const R at = nearest + least * sine / cosine;
        const R away = least / cosine;
        const R height = path.eye.z + path.way.z * at;
        const R depth = path.of_fog(at) + optical_depth(path.air, lamp.position_m.z, height, away);
        R share(1);
        if (lamp.kind == LampKind::spot)
        {
            const Vec3<R> from_lamp = (path.way * at - to_lamp) * (R(1) / away);
            const R width = max(lamp.cos_inner - lamp.cos_outer, R(kNarrowestCone));
            share = clamp((dot(lamp.direction, from_lamp) - lamp.cos_outer) / width, R(0), R(1));
            share = share * share;
        }
        const R reach = away / lamp.range_m;
        const R window = max(R(1) - (reach * reach) * (reach * reach), R(0));
        // the light goes on from the lamp's side: the cosine to the eye is -sin(theta)
        sum = sum + R(kGauss8Weight[k < 4 ? k : k - 4]) * share * window * path.fog_at(at) * exp(-depth) *
                        scattered_share(lamp.phase, -sine);
    }
    return lamp.intensity * (sum * half / least);
}

/// The same over the whole way up to `to_m`, cut at the flakes' volume.
template <class R>
SPINDRIFT_HD Vec3<R> airlight_to(const AirPath<R>& path, const Lamp<R>& lamp, const R& to_m)
{
    const R in = min(path.enters_m, to_m), out = min(path.leaves_m, to_m);
    Vec3<R> sum = airlight(path, lamp, out, to_m);
    if (in > R(0)) sum = sum + airlight(path, lamp, R(0), in);
    if (out > in) sum = sum + airlight(path, lamp, in, out);
    return sum;
}

}  // namespace spindrift
