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

/// The part of a way, in m, that a point or spot lamp reaches: its range and its cone. Empty: to <= from.
template <class R>
struct LitPart
{
    R from, to;
};

/// The part of the line away + t way that lies in a spot's cone: u(t) = dot(direction, x) >= 0 and u² >= cos²
/// |x|².
template <class R>
SPINDRIFT_HD LitPart<R> part_in_cone(const Lamp<R>& lamp, const Vec3<R>& away, const Vec3<R>& way)
{
    const R zero = number<R>(0), tiny = number<R>(1e-9), endless = infinity<R>();
    const R along = dot(away, way), cos2 = lamp.cos_outer * lamp.cos_outer;
    const R u0 = dot(lamp.direction, away), u1 = dot(lamp.direction, way);
    const R a = u1 * u1 - cos2, b = u0 * u1 - cos2 * along, c = u0 * u0 - cos2 * dot(away, away);
    const R determinant = b * b - a * c;
    const auto linear = abs(a) < tiny;  // parallel to the cone's side
    const auto constant = linear && abs(b) < tiny;
    const auto misses = constant || (!linear && determinant < zero);  // the cone's surface
    const R root = sqrt(max(determinant, zero));
    const R inverse = number<R>(1) / select(linear, number<R>(1), a);
    const R one = (-b - root) * inverse, other = (root - b) * inverse;
    const R straight = c / select(constant, number<R>(1), number<R>(-2) * b);
    const R first = select(linear, straight, min(one, other));
    const R second = select(linear, straight, max(one, other));
    // a < 0: enters and leaves one of the two cones that meet in the lamp. Else it runs from one into the
    // other, and the lamp's own is the one that the way turns to.
    const auto passes = !linear && a < zero;
    const auto turns_in = select(linear, b, u1) > zero;
    const R from = select(passes, first, select(turns_in, second, -endless));
    const R to = select(passes, second, select(turns_in, endless, first));
    const auto other_cone = passes && !(u0 + u1 * number<R>(0.5) * (first + second) > zero);
    const auto inside = u0 > zero && select(constant, c, a) > zero;
    const auto never =
        select(misses, select(inside, zero, number<R>(1)), select(other_cone, number<R>(1), zero)) > zero;
    return {select(never, endless, select(misses, -endless, from)),
            select(never, -endless, select(misses, endless, to))};
}

template <class R>
SPINDRIFT_HD LitPart<R> lit_part(const Lamp<R>& lamp, const Vec3<R>& eye, const Vec3<R>& way, R from, R to)
{
    const Vec3<R> away = eye - lamp.position_m;
    const R along = dot(away, way);
    const R inside = lamp.range_m * lamp.range_m - (dot(away, away) - along * along);
    const R half = sqrt(max(inside, number<R>(0)));
    from = max(from, -along - half);
    to = select(inside > number<R>(0), min(to, half - along), from);
    if (lamp.kind != LampKind::spot) return {from, to};
    const LitPart<R> cone = part_in_cone(lamp, away, way);
    return {max(from, cone.from), min(to, cone.to)};
}

/// Share of a lamp's light that the air lets through to a place; all of a directional lamp's.
template <class R>
SPINDRIFT_HD R reaching(const AirLayers<R>& air, const Lamp<R>& lamp, const Vec3<R>& place)
{
    if (lamp.kind == LampKind::directional) return number<R>(1);
    const Vec3<R> way = lamp.position_m - place;
    return exp(-optical_depth(air, lamp.position_m.z, place.z, sqrt(dot(way, way))));
}

/// A lamp that nothing stands before. Others give the share of a lamp's light that reaches a place.
struct NothingBetween
{
    template <class R>
    SPINDRIFT_HD R operator()(const Vec3<R>&) const
    {
        return number<R>(1);
    }
};

/// Places and weights of the Gauss-Legendre rule over [-1, 1].
SPINDRIFT_HD double airlight_place(int k)
{
    constexpr double half[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                0.9602898564975363};
    return k < 4 ? -half[k] : half[k - 4];
}
SPINDRIFT_HD double airlight_weight(int k)
{
    constexpr double half[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                0.1012285362903763};
    return half[k < 4 ? k : k - 4];
}

/// Radiance towards the eye, W/(m2 sr), of a point or spot lamp's light from the part [from, to] of a way.
/// The extinction must be smooth there: cut the way where it enters and leaves the flakes' volume.
template <class R, class Reach = NothingBetween>
SPINDRIFT_HD Vec3<R> airlight(const AirPath<R>& path, const Lamp<R>& lamp, const R& from_m, const R& to_m,
                              const Reach& reach = {})
{
    const R zero = number<R>(0), one = number<R>(1);
    const LitPart<R> lit = lit_part(lamp, path.eye, path.way, from_m, to_m);
    const auto any_lit = lit.to > lit.from;
    if (none(any_lit)) return {zero, zero, zero};
    const Vec3<R> to_lamp = lamp.position_m - path.eye;
    const R nearest = dot(to_lamp, path.way);
    const R least2 = dot(to_lamp, to_lamp) - nearest * nearest;
    const R least = sqrt(max(least2, number<R>(kNearestLight_m * kNearestLight_m)));
    const R first = atan((select(any_lit, lit.from, zero) - nearest) / least);
    const R last = atan((select(any_lit, lit.to, zero) - nearest) / least);
    const R middle = number<R>(0.5) * (first + last), half = number<R>(0.5) * (last - first);
    R sum = zero;
    for (int k = 0; k < kAirlightPoints; ++k)
    {
        R sine, cosine;
        sincos_turns((middle + half * number<R>(airlight_place(k))) * number<R>(0.15915494309189533577), sine,
                     cosine);
        const R at = nearest + least * sine / cosine;
        const R away = least / cosine;
        const R height = path.eye.z + path.way.z * at;
        const R depth = path.of_fog(at) + optical_depth(path.air, lamp.position_m.z, height, away);
        R share = one;
        if (lamp.kind == LampKind::spot)
        {
            const Vec3<R> from_lamp = (path.way * at - to_lamp) * (one / away);
            const R width = max(lamp.cos_inner - lamp.cos_outer, number<R>(kNarrowestCone));
            share = clamp((dot(lamp.direction, from_lamp) - lamp.cos_outer) / width, zero, one);
            share = share * share;
        }
        const R far = away / lamp.range_m;
        const R window = max(one - (far * far) * (far * far), zero);
        // the light goes on from the lamp's side: the cosine to the eye is -sin(theta)
        sum = sum + number<R>(airlight_weight(k)) * share * window * path.fog_at(at) * exp(-depth) *
                        scattered_share(lamp.phase, -sine) * reach(path.eye + path.way * at);
    }
    return lamp.intensity * (sum * half / least);
}

/// The same over the whole way up to `to_m`, cut at the flakes' volume.
template <class R, class Reach = NothingBetween>
SPINDRIFT_HD Vec3<R> airlight_to(const AirPath<R>& path, const Lamp<R>& lamp, const R& to_m,
                                 const Reach& reach = {})
{
    const R zero = number<R>(0);
    const R in = min(path.enters_m, to_m), out = min(path.leaves_m, to_m);
    Vec3<R> sum = airlight(path, lamp, out, to_m, reach);
    if (any(in > zero)) sum = sum + airlight(path, lamp, zero, in, reach);
    if (any(out > in)) sum = sum + airlight(path, lamp, in, out, reach);
    return sum;
}

/// Share of parallel light that reaches the fog on the way up to `to_m`, each part counting by what the eye
/// gets of it: the mean over eight points that stand at equal shares of an even fog's light.
template <class R, class Reach>
SPINDRIFT_HD R share_in_fog(const AirPath<R>& path, const R& to_m, const Reach& reach)
{
    const R zero = number<R>(0), one = number<R>(1);
    const R depth = path.of_fog(to_m), hidden = one - exp(-depth);
    const auto thin = depth < number<R>(1e-3);  // the light comes evenly from everywhere
    const R per_m = select(thin, one, depth) / to_m;
    R lit = zero, all = zero;
    for (int k = 0; k < kAirlightPoints; ++k)
    {
        const R share = number<R>(0.5 + 0.5 * airlight_place(k));
        const R left = one - share * hidden;
        const R at = select(thin, share * to_m, -log(left) / per_m);
        // dt / dshare is to_m, or hidden / (per_m left)
        const R weight =
            number<R>(airlight_weight(k)) * path.fog_at(at) * exp(-path.of_fog(at)) / select(thin, one, left);
        all = all + weight;
        lit = lit + weight * reach(path.eye + path.way * at);
    }
    return select(all > zero, lit / select(all > zero, all, one), one);
}

}  // namespace spindrift
