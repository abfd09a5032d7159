// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/encounter.h"
#include "core/flake.h"
#include "core/langevin.h"
#include "core/philox.h"
#include "core/snow.h"
#include "core/wind.h"

namespace spindrift
{

inline constexpr double kGravity = 9.80665;  ///< m/s^2

/// Slip below this speed (m/s) is none: it would fade through the denormal numbers for a second without
/// moving anything.
inline constexpr double kLeastSlip = 1e-6;

/// Lane by lane.
template <class Mask, class R>
SPINDRIFT_HD Vec3<R> select(const Mask& mask, const Vec3<R>& yes, const Vec3<R>& no)
{
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

/// The step that a kernel makes.
struct StepParams
{
    float dt_s = 0;
    std::uint64_t seed = 0;
    std::uint32_t number = 0;
};

/// What a kernel has done besides while a pack moves, in four quarters spread over that work: here, nothing.
struct NothingMeanwhile
{
    SPINDRIFT_HD void quarter(int) const {}
};

/// Moves one pack of flakes by one step: wind, turbulence, settling, slip, and what stands in the way.
/// R: float or a SIMD pack of float. Resolver: EncounterResolver, or one that calls it out of line. Wind:
/// UniformWind, LogWind or GridWind. All variants give the same bits. Scheme: docs/physics.md "Turbulence",
/// docs/decisions/006-one-relaxation-two-samples.md.
template <class R, class WindField, bool Turbulent, class Resolver = EncounterResolver>
struct FlakeAdvector
{
    using Int = IntOf<R>;
    using UInt = UIntOf<R>;
    using Mask = MaskOf<R>;
    static constexpr int width = NumberTraits<R>::width;

    StepParams step;
    WindField wind;
    FallSpeed fall_speed;
    Surroundings around;
    FlakeView flakes;

    /// Slots [first, first + width). `meanwhile` gets each quarter once, unless all of them are dead.
    template <class Tally, class Meanwhile = NothingMeanwhile>
    SPINDRIFT_HD void operator()(std::size_t first, Tally& tally, const Meanwhile& meanwhile = {}) const
    {
        meanwhile.quarter(0);
        const UInt state = load<UInt>(flakes.state + first);
        Mask alive = (state & UInt(0xFFU)) == UInt(0U);
        if (none(alive)) return;

        Pack p = load_pack(first, state);
        if constexpr (Turbulent)
        {
            Air<R> air = wind.air(p.x);
            meanwhile.quarter(1);
            const Int n = substeps<R>(air.gradient, R(step.dt_s));
            const R h = R(step.dt_s) / to_real<R>(n);
            for (int k = 0;; ++k)
            {
                const Mask moving = alive && Int(k) < n;
                if (none(moving)) break;
                if (k > 0) air = wind.air(p.x);
                const Gaussians<R> noise = gaussians<R>(
                    step.seed, p.id, step.number, RandomStream::turbulence, static_cast<std::uint32_t>(k));
                if (k == 0) meanwhile.quarter(2);
                const Move move = turbulent_move(p, air, h, noise);
                if (k == 0) meanwhile.quarter(3);
                alive = arrive(p, move, moving, alive, static_cast<std::uint32_t>(k), tally);
            }
        }
        else
        {
            meanwhile.quarter(1);
            const Move move = smooth_move(p, R(step.dt_s));
            meanwhile.quarter(2);
            meanwhile.quarter(3);
            arrive(p, move, alive, alive, 0, tally);
        }
        store_pack(first, p);
    }

  private:
    struct Pack
    {
        Vec3<R> x, q, slip;
        UInt id, state;
        R fall;
    };

    /// A sub-step before anything was met.
    struct Move
    {
        Vec3<R> path;  ///< m
        Vec3<R> q, slip;
        Air<R> air;  ///< half way; of it only mean and S are used
    };

    SPINDRIFT_HD Pack load_pack(std::size_t i, const UInt& state) const
    {
        Pack p;
        p.x = {load<R>(flakes.x + i), load<R>(flakes.y + i), load<R>(flakes.z + i)};
        if constexpr (Turbulent)
            p.q = {load<R>(flakes.q1 + i), load<R>(flakes.q2 + i), load<R>(flakes.q3 + i)};
        else
            p.q = {number<R>(0), number<R>(0), number<R>(0)};
        p.slip = {load<R>(flakes.slip_x + i), load<R>(flakes.slip_y + i), load<R>(flakes.slip_z + i)};
        p.id = load<UInt>(flakes.id + i);
        p.state = state;
        p.fall = fall_speed.template at<R>(p.id);
        return p;
    }

    SPINDRIFT_HD void store_pack(std::size_t i, const Pack& p) const
    {
        store(flakes.x + i, p.x.x), store(flakes.y + i, p.x.y), store(flakes.z + i, p.x.z);
        if constexpr (Turbulent)
        {
            store(flakes.q1 + i, p.q.x), store(flakes.q2 + i, p.q.y), store(flakes.q3 + i, p.q.z);
        }
        store(flakes.slip_x + i, p.slip.x), store(flakes.slip_y + i, p.slip.y);
        store(flakes.slip_z + i, p.slip.z);
        store(flakes.state + i, p.state);
    }

    /// Relaxation of q over the whole sub-step, then the deterministic flow dx = (U + S q) dt, dq = div S dt
    /// by the midpoint rule.
    SPINDRIFT_HD Move turbulent_move(const Pack& p, const Air<R>& air, const R& h,
                                     const Gaussians<R>& noise) const
    {
        const Vec3<R> q = relax(p.q, air.rate, h, Vec3<R>{noise.x, noise.y, noise.z});
        const R half = h * number<R>(0.5);
        Move m;
        m.air = wind.air(half_way(p, air.mean + turbulent_velocity(air, q), half));
        const Vec3<R> q_half = {fma(half, air.div_s.x, q.x), fma(half, air.div_s.y, q.y),
                                fma(half, air.div_s.z, q.z)};
        m.q = {fma(h, m.air.div_s.x, q.x), fma(h, m.air.div_s.y, q.y), fma(h, m.air.div_s.z, q.z)};
        finish(p, m.air.mean + turbulent_velocity(m.air, q_half), h, m);
        return m;
    }

    SPINDRIFT_HD Move smooth_move(const Pack& p, const R& h) const
    {
        Move m;
        m.air = Air<R>{};
        m.air.mean = wind.mean(half_way(p, wind.mean(p.x), h * number<R>(0.5)));
        m.q = p.q;
        finish(p, m.air.mean, h, m);
        return m;
    }

    SPINDRIFT_HD Vec3<R> half_way(const Pack& p, const Vec3<R>& air, const R& half) const
    {
        return {fma(half, air.x, p.x.x), fma(half, air.y, p.x.y), fma(half, air.z - p.fall, p.x.z)};
    }

    /// Path of air plus settling plus slip; the slip decays with tau = v_t / g, and its path is exact.
    SPINDRIFT_HD void finish(const Pack& p, const Vec3<R>& air, const R& h, Move& m) const
    {
        m.path = {h * air.x, h * air.y, h * (air.z - p.fall)};
        m.slip = p.slip;
        const R zero = number<R>(0);
        const Mask slipping = p.slip.x != zero || p.slip.y != zero || p.slip.z != zero;
        if (none(slipping)) return;
        const R tau = p.fall * number<R>(1.0 / kGravity);
        const R kept = exp(-(h / tau));
        const R path = tau * (number<R>(1) - kept);
        const auto fade = [&](const R& slip, R& along, R& left)
        {
            along = select(slipping, fma(slip, path, along), along);
            const R faded = slip * kept;
            left = select(abs(faded) < number<R>(kLeastSlip), zero, faded);
        };
        fade(p.slip.x, m.path.x, m.slip.x);
        fade(p.slip.y, m.path.y, m.slip.y);
        fade(p.slip.z, m.path.z, m.slip.z);
    }

    /// Puts the moving lanes at the end of their path, or where what they met leaves them. Returns who is
    /// still alive.
    template <class Tally>
    SPINDRIFT_HD Mask arrive(Pack& p, const Move& m, const Mask& moving, const Mask& alive,
                             std::uint32_t substep, Tally& tally) const
    {
        const Vec3<R> from = p.x;
        p.x = select(moving, from + m.path, from);
        p.q = select(moving, m.q, p.q);
        p.slip = select(moving, m.slip, p.slip);
        const Mask meets = moving && around.may_meet(from, m.path, p.state);
        if (none(meets)) return alive;
        meet(mask_bits(meets), from, p, m, substep, tally);
        return alive && (p.state & UInt(0xFFU)) == UInt(0U);
    }

    SPINDRIFT_HD static int lowest_lane(std::uint32_t lanes)
    {
        if constexpr (width == 1)
            return 0;
        else
            return __builtin_ctz(lanes);
    }

    /// The lanes of `lanes` one by one.
    template <class Tally>
    SPINDRIFT_HD void meet(std::uint32_t lanes, const Vec3<R>& from, Pack& p, const Move& m,
                           std::uint32_t substep, Tally& tally) const
    {
        Lanes x(from), path(m.path), q(p.q), slip(p.slip), mean(m.air.mean), end(p.x);
        Lanes s1({m.air.s11, m.air.s21, m.air.s22}), s2({m.air.s31, m.air.s32, m.air.s33});
        float fall[width];
        std::uint32_t id[width], state[width];
        store(fall, p.fall), store(id, p.id), store(state, p.state);
        const Resolver resolve{around, step.seed, step.number, substep, Turbulent};
        for (; lanes != 0; lanes &= lanes - 1)
        {
            const int l = lowest_lane(lanes);
            Encounter f;
            f.x = x[l], f.path = path[l], f.q = q[l], f.slip = slip[l];
            f.air.mean = mean[l];
            f.air.s11 = s1.x[l], f.air.s21 = s1.y[l], f.air.s22 = s1.z[l];
            f.air.s31 = s2.x[l], f.air.s32 = s2.y[l], f.air.s33 = s2.z[l];
            f.fall = fall[l], f.id = id[l], f.state = state[l];
            resolve(f, tally);
            end.put(l, f.x), q.put(l, f.q), slip.put(l, f.slip);
            state[l] = f.state;
        }
        p.x = end.pack(), p.q = q.pack(), p.slip = slip.pack();
        p.state = load<UInt>(state);
    }

    /// A vector pack in memory, where its lanes can be had one by one.
    struct Lanes
    {
        float x[width], y[width], z[width];

        SPINDRIFT_HD explicit Lanes(const Vec3<R>& v) { store(x, v.x), store(y, v.y), store(z, v.z); }
        SPINDRIFT_HD Vec3f operator[](int l) const { return {x[l], y[l], z[l]}; }
        SPINDRIFT_HD void put(int l, const Vec3f& v) { x[l] = v.x, y[l] = v.y, z[l] = v.z; }
        SPINDRIFT_HD Vec3<R> pack() const { return {load<R>(x), load<R>(y), load<R>(z)}; }
    };
};

}  // namespace spindrift
