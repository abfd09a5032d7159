// SPDX-License-Identifier: MIT
#pragma once

#include "core/langevin.h"
#include "core/math.h"
#include "core/philox.h"
#include "core/turbulence.h"
#include "core/wind.h"

namespace spindrift::validation
{

// Steps of the Langevin model that ours is compared with, and ours over any number type, as the truth of its
// own rounding. x is moved, the state is u' or q. Docs: docs/validation.md "Integrators".

/// The air as models over u' want it. `spread`: its stress, `divergence`: d_i tau_ij.
template <class R>
struct StressAir
{
    Vec3<R> mean;
    Stress<R> spread;
    Vec3<R> divergence;
    R c0_eps;
};

/// From the sixteen numbers of a study's cell.
template <class R>
SPINDRIFT_HD StressAir<R> stress_air_of(const R (&v)[16])
{
    return {{v[0], v[1], v[2]}, {v[4], v[5], v[6], v[7], v[8], v[9]}, {v[10], v[11], v[12]}, v[13]};
}

template <class R>
SPINDRIFT_HD Vec3<R> times(const Stress<R>& t, const Vec3<R>& v)
{
    return {t.xx * v.x + t.xy * v.y + t.xz * v.z, t.xy * v.x + t.yy * v.y + t.yz * v.z,
            t.xz * v.x + t.yz * v.y + t.zz * v.z};
}

template <class R>
SPINDRIFT_HD R determinant(const Stress<R>& t)
{
    return t.xx * (t.yy * t.zz - t.yz * t.yz) - t.xy * (t.xy * t.zz - t.yz * t.xz) +
           t.xz * (t.xy * t.yz - t.yy * t.xz);
}

/// 0 where the determinant is.
template <class R>
SPINDRIFT_HD Stress<R> inverse(const Stress<R>& t)
{
    const R det = determinant(t);
    const R i = det != R(0) ? R(1) / det : R(0);
    return {(t.yy * t.zz - t.yz * t.yz) * i, (t.xz * t.yz - t.xy * t.zz) * i,
            (t.xy * t.yz - t.xz * t.yy) * i, (t.xx * t.zz - t.xz * t.xz) * i,
            (t.xy * t.xz - t.xx * t.yz) * i, (t.xx * t.yy - t.xy * t.xy) * i};
}

template <class R>
SPINDRIFT_HD Stress<R> rate_of_change(const Stress<R>& now, const Stress<R>& before, R dt)
{
    const R i = R(1) / dt;
    return {(now.xx - before.xx) * i, (now.xy - before.xy) * i, (now.xz - before.xz) * i,
            (now.yy - before.yy) * i, (now.yz - before.yz) * i, (now.zz - before.zz) * i};
}

/// Thomson (1987), simplest Gaussian model, by explicit Euler: du = (-C0 eps / 2 L u + div tau / 2 + dtau/dt
/// L u / 2) dt + sqrt(C0 eps) dW, L = tau^-1, dtau/dt along the path. `air_at(x)` gives a StressAir.
struct ExplicitEuler
{
    template <class R, class AirAt>
    static SPINDRIFT_HD void step(const AirAt& air_at, R dt, const Vec3<R>& noise, Vec3<R>& x, Vec3<R>& u)
    {
        const StressAir<R> air = air_at(x);
        const Stress<R> change = rate_of_change(air.spread, air_at(x - (air.mean + u) * dt).spread, dt);
        const Vec3<R> lu = times(inverse(air.spread), u);
        const Vec3<R> drift = (lu * -air.c0_eps + air.divergence + times(change, lu)) * (R(0.5) * dt);
        u = u + drift + noise * sqrt(air.c0_eps * dt);
        x = x + (air.mean + u) * dt;
    }
};

/// Bailey (2017), as QES-Plume steps: the same equation, implicit in u: (I - (dt/2) (-C0 eps L + L dtau/dt))
/// u' = u + div tau dt / 2 + sqrt(C0 eps dt) noise.
struct Bailey
{
    template <class R, class AirAt>
    static SPINDRIFT_HD void step(const AirAt& air_at, R dt, const Vec3<R>& noise, Vec3<R>& x, Vec3<R>& u)
    {
        const StressAir<R> air = air_at(x);
        const Stress<R> change = rate_of_change(air.spread, air_at(x - (air.mean + u) * dt).spread, dt);
        const Stress<R> l = inverse(air.spread);
        // column j of I + dt/2 (C0 eps L - L change)
        const R half = R(0.5) * dt;
        const auto column = [&](const Vec3<R>& change_j, const Vec3<R>& l_j, const Vec3<R>& unit)
        { return unit + (l_j * air.c0_eps - times(l, change_j)) * half; };
        const Vec3<R> a = column({change.xx, change.xy, change.xz}, {l.xx, l.xy, l.xz}, {R(1), R(0), R(0)});
        const Vec3<R> b = column({change.xy, change.yy, change.yz}, {l.xy, l.yy, l.yz}, {R(0), R(1), R(0)});
        const Vec3<R> c = column({change.xz, change.yz, change.zz}, {l.xz, l.yz, l.zz}, {R(0), R(0), R(1)});
        const Vec3<R> right = u + air.divergence * half + noise * sqrt(air.c0_eps * dt);
        // Cramer's rule
        const Vec3<R> bc = cross(b, c);
        u = Vec3<R>{dot(right, bc), dot(a, cross(right, c)), dot(a, cross(b, right))} * (R(1) / dot(a, bc));
        x = x + (air.mean + u) * dt;
    }
};

/// The exact Ornstein-Uhlenbeck step of u' = sigma q, q <- e^(-dt/T) q + ..., and then x <- x + u dt, with
/// the drift of q in between: what is exact alone, but not as a sum (K is (a/2) coth (a/2) times too large).
/// Diagonal stress.
struct ExactOuPlusSum
{
    template <class R, class AirAt>
    static SPINDRIFT_HD void step(const AirAt& air_at, R dt, const Vec3<R>& noise, Vec3<R>& x, Vec3<R>& u)
    {
        const StressAir<R> air = air_at(x);
        const auto one = [&](R& v, R variance, R divergence, R xi)
        {
            const R r = exp(-(R(0.5) * air.c0_eps / variance * dt));
            // div tau / 2 is sigma sigma'; the whitened drift takes u with sigma along the path
            v = r * v + sqrt(variance * (R(1) - r * r)) * xi + R(0.5) * divergence * dt;
        };
        const Vec3<R> from{sqrt(air.spread.xx), sqrt(air.spread.yy), sqrt(air.spread.zz)};
        one(u.x, air.spread.xx, air.divergence.x, noise.x);
        one(u.y, air.spread.yy, air.divergence.y, noise.y);
        one(u.z, air.spread.zz, air.divergence.z, noise.z);
        x = x + (air.mean + u) * dt;
        const StressAir<R> to = air_at(x);  // u keeps its place in the distribution
        u = {u.x * sqrt(to.spread.xx) / from.x, u.y * sqrt(to.spread.yy) / from.y,
             u.z * sqrt(to.spread.zz) / from.z};
    }
};

/// Ours (core/advect.h) without contacts: Cayley's relaxation, and the flow by the midpoint rule in sub-steps
/// by gradient. `noise(r)` is that of relaxation r. tests/accuracy/study_test.cpp holds it to the backend.
struct Whitened
{
    template <class R, class Wind, class Noise>
    static SPINDRIFT_HD void step(const Wind& wind, R dt, int relaxations, const Noise& noise, Vec3<R>& x,
                                  Vec3<R>& q)
    {
        const R part = dt / R(relaxations);
        for (int r = 0; r < relaxations; ++r)
        {
            Air<R> air = wind.air(x);
            q = relax(air, q, air.c0_eps * (part * R(0.25)), noise(r));
            const int n = substeps<R>(air.gradient, part);
            const R h = part / R(n), half = R(0.5) * h;
            for (int k = 0; k < n; ++k)
            {
                if (k > 0) air = wind.air(x);
                const Air<R> middle = wind.air(x + (air.mean + turbulent_velocity(air, q)) * half);
                const Vec3<R> q_half = q + air.div_s * half;
                q = q + middle.div_s * h;
                x = x + (middle.mean + turbulent_velocity(middle, q_half)) * h;
            }
        }
    }
};

}  // namespace spindrift::validation
