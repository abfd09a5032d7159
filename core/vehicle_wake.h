// SPDX-License-Identifier: MIT
#pragma once

#include "core/math.h"
#include "core/number.h"
#include "core/vec.h"

namespace spindrift
{

/// A blunt box on the ground at one moment.
struct MovingBody
{
    Vec3f place{};                       ///< middle of its foot, local frame
    float to_x = 1, to_y = 0;            ///< unit vector along which it drives
    float excess_m_s = 0;                ///< its speed less that of the air along it
    float length_m = 0, frontal_m2 = 0;  ///< no frontal area: no body
};

/// The velocity, m/s, that a body gives the air at x. Air beside and inside it goes along with it; before it,
/// air is pushed aside; behind it, the velocity falls as distance^(-2/3) while the wake widens as
/// distance^(1/3) (the similar wake of a round blunt body, Tennekes & Lumley 1972, 4.3), and fades over
/// fifteen bubble lengths into the turbulence of the air. With s along the way, r from the line on the ground
/// under its middle, the Stokes stream function is psi = V f b^2 (1 - exp(-r^2 / 2 b^2)), pi b^2 the frontal
/// area: exactly free of divergence, and level at the ground. docs/physics.md "Vehicles".
template <class R>
SPINDRIFT_HD Vec3<R> vehicle_wake(const MovingBody& body, const Vec3<R>& x)
{
    const R dx = x.x - R(body.place.x), dy = x.y - R(body.place.y);
    const R height = max(x.z - R(body.place.z), number<R>(0));
    const R along = dx * R(body.to_x) + dy * R(body.to_y);
    const R across = dy * R(body.to_x) - dx * R(body.to_y);
    const R behind_front = number<R>(0.5) * R(body.length_m) - along;
    const R behind = behind_front - R(body.length_m);
    const R width2 = R(body.frontal_m2) * number<R>(0.31830988618379067154);  // of the body, b^2
    const R bubble = number<R>(2) * sqrt(R(body.frontal_m2));

    // f, b^2, and the derivatives along the wake of f b^2 and of ln b
    R f = number<R>(1), b2 = width2, flux_slope = number<R>(0), widening = number<R>(0);
    if (behind_front < number<R>(0))
    {
        f = exp(-(behind_front * behind_front) / width2);
        flux_slope = number<R>(-2) * behind_front * f;  // (f b^2)' = f' b^2
    }
    else if (behind > number<R>(0))
    {
        const R fade = number<R>(15) * bubble;
        const R part = behind / bubble;
        const R g2 = fma(part, part, number<R>(1));
        const R third = log2(g2) * number<R>(1.0 / 6.0);  // log2 of g^(1/3)
        const R left = exp(-(behind * behind) / (fade * fade));
        f = exp2(number<R>(-2) * third) * left;
        b2 = width2 * exp2(number<R>(2) * third);
        flux_slope = width2 * left * (number<R>(-2) * behind / (fade * fade));
        widening = part / (number<R>(3) * bubble * g2);
    }
    const R r2 = across * across + height * height;
    const R q = number<R>(0.5) * r2 / b2;
    const R e = exp(-q);
    // (1 - exp(-q)) / r^2, whose limit on the axis is 1 / (2 b^2)
    const R spread = q > number<R>(1e-3) ? (number<R>(1) - e) / r2
                                         : (number<R>(1) - number<R>(0.5) * q) / (number<R>(2) * b2);
    const R speed = R(body.excess_m_s);
    const R out = speed * (flux_slope * spread - f * e * widening);  // radial velocity over r
    const R forward = speed * f * e;
    return {forward * R(body.to_x) - out * across * R(body.to_y),
            forward * R(body.to_y) + out * across * R(body.to_x), out * height};
}

}  // namespace spindrift
