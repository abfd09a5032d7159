// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

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
    bool inertial = false;       ///< FlakeView::slip is the whole velocity of a flake
    int relaxations = 1;         ///< in a step, the same for all flakes (core/gradient_reach.h)
    bool near_walls = false;     ///< a step may go farther than a cell of the solids
    bool fine = false;           ///< a step moves by so few last places that rounding needs its dice
    float crossing_squared = 0;  ///< beta^2 of the crossing of trajectories; 0: none
};

/// Whether steps of this length are fine in a domain of this extent: air of 1 m/s then moves a flake by fewer
/// than so many units in the last place of its coordinates, and the rounding of one step after the other
/// would be felt (docs/physics.md "Far away and in small steps").
inline constexpr double kFineLastPlaces = 256;
SPINDRIFT_HD bool is_fine(double step_s, double extent_m)
{
    return step_s < kFineLastPlaces * 0x1p-24 * extent_m;
}

/// What a kernel has done besides while a pack moves, in four quarters spread over that work: here, nothing.
struct NothingMeanwhile
{
    SPINDRIFT_HD void quarter(int) const {}
};

/// In place of a Resolver: a flake that may meet something is left as it was, for others to move, and the
/// Tally is told by left_over(slot). So a device moves most flakes without the registers of encounters
/// (docs/decisions/031-free-flakes-first.md).
struct OnlyFreeFlakes
{
};

/// Moves one pack of flakes by one step: wind, turbulence, settling, slip, and what stands in the way.
/// R: float or a SIMD pack of float. Resolver: EncounterResolver, one that calls it out of line, or for float
/// OnlyFreeFlakes. Wind: UniformWind, LogWind or GridWind. All variants give the same bits. Scheme:
/// docs/physics.md "Turbulence", docs/decisions/006-one-relaxation-cut-flow.md.
template <class R, class WindField, bool Turbulent, class Resolver = EncounterResolver>
struct FlakeAdvector
{
    using Int = IntOf<R>;
    using UInt = UIntOf<R>;
    using Mask = MaskOf<R>;
    static constexpr int width = NumberTraits<R>::width;
    static constexpr bool kOnlyFree = std::is_same_v<Resolver, OnlyFreeFlakes>;
    static_assert(!kOnlyFree || width == 1, "a pack is moved as a whole");

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
            const R part = R(step.dt_s / static_cast<float>(step.relaxations));
            for (int r = 0; r < step.relaxations && !none(alive); ++r)
            {
                Air<R> air = wind.air(p.x);
                if (r == 0) meanwhile.quarter(1);
                const Gaussians<R> noise = gaussians<R>(
                    step.seed, p.id, step.number, RandomStream::turbulence, static_cast<std::uint32_t>(r));
                if (r == 0) meanwhile.quarter(2);
                p.q = select(
                    alive, relax(air, p.q, relaxation(air, p.fall, part), Vec3<R>{noise.x, noise.y, noise.z}),
                    p.q);
                const Int n = substeps<R>(air.gradient, part);
                const R h = part / to_real<R>(n);
                for (int k = 0;; ++k)
                {
                    const Mask moving = alive && Int(k) < n;
                    if (none(moving)) break;
                    if (k > 0) air = wind.air(p.x);
                    alive = flow(p, air, h, moving, alive, static_cast<std::uint32_t>(r * kMostSubsteps + k),
                                 tally);
                    if (r == 0 && k == 0) meanwhile.quarter(3);
                }
            }
        }
        else
        {
            meanwhile.quarter(1);
            Air<R> air{};
            air.mean = wind.mean(p.x);
            alive = flow(p, air, R(step.dt_s), alive, alive, 0, tally);
            meanwhile.quarter(2);
            meanwhile.quarter(3);
        }
        if constexpr (kOnlyFree)
            if (!alive) return tally.left_over(first);
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
        p.fall = fall_speed.template at<R>(p.id, state);
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

    /// The deterministic flow dx = (U + S q) dt, dq = div S dt over h seconds, from where `air` was sampled:
    /// at once, or where walls are near and steps long in pieces that reach no farther than to the next wall.
    /// Its pieces do not change what relaxes, so that there is no seam between them and whole steps
    /// (docs/physics.md "Motion").
    template <class Tally>
    SPINDRIFT_HD Mask flow(Pack& p, Air<R>& air, const R& h, const Mask& moving, Mask alive,
                           std::uint32_t substep, Tally& tally) const
    {
        if constexpr (kOnlyFree)
        {
            if (step.near_walls && time_to_wall(p, air, h) < h) return false;
            const auto index = step.near_walls ? substep * static_cast<std::uint32_t>(kMostPieces) : substep;
            return arrive(p, move(p, air, h, index), moving, alive, index, tally);
        }
        if (!step.near_walls) return arrive(p, move(p, air, h, substep), moving, alive, substep, tally);
        R left = h;
        for (int piece = 0; piece < kMostPieces; ++piece)
        {
            const Mask going = moving && alive && left > number<R>(0);
            if (none(going)) break;
            if (piece > 0) sample(p.x, air);
            const R now = piece + 1 < kMostPieces ? min(left, time_to_wall(p, air, h)) : left;
            const auto index =
                substep * static_cast<std::uint32_t>(kMostPieces) + static_cast<std::uint32_t>(piece);
            alive = arrive(p, move(p, air, now, index), going, alive, index, tally);
            left = left - now;
        }
        return alive;
    }

    SPINDRIFT_HD void sample(const Vec3<R>& x, Air<R>& air) const
    {
        if constexpr (Turbulent)
            air = wind.air(x);
        else
            air.mean = wind.mean(x);
    }

    /// Time in which the air carries a flake through cells that are surely free, or through one cell; not
    /// less than an even share of h.
    SPINDRIFT_HD R time_to_wall(const Pack& p, const Air<R>& air, const R& h) const
    {
        const Voxels& voxels = around.solids.voxels;
        const R one = number<R>(1);
        const R reach = max(to_real<R>(voxels.clearance_of(p.x)) - one, one) * R(voxels.cell_m);
        const Vec3<R> u = velocity(air, p.q);
        const R speed = max(max(abs(u.x), abs(u.y)), abs(u.z));
        return max(reach / max(speed, number<R>(1e-6)), h * number<R>(1.0 / kMostPieces));
    }

    SPINDRIFT_HD static Vec3<R> velocity(const Air<R>& air, const Vec3<R>& q)
    {
        if constexpr (Turbulent)
            return air.mean + turbulent_velocity(air, q);
        else
            return air.mean;
    }

    /// By the midpoint rule.
    SPINDRIFT_HD Move move(const Pack& p, const Air<R>& air, const R& h, std::uint32_t substep) const
    {
        const R half = h * number<R>(0.5);
        Move m;
        m.air = Air<R>{};
        sample(half_way(p, velocity(air, p.q), half), m.air);
        m.q = p.q;
        Vec3<R> q_half = p.q;
        if constexpr (Turbulent)
        {
            const Vec3<R>& gain = air.div_s;
            q_half = {fma(half, gain.x, p.q.x), fma(half, gain.y, p.q.y), fma(half, gain.z, p.q.z)};
            const Vec3<R>& all = m.air.div_s;
            m.q = {fma(h, all.x, p.q.x), fma(h, all.y, p.q.y), fma(h, all.z, p.q.z)};
        }
        finish(p, velocity(m.air, q_half), h, substep, m);
        return m;
    }

    /// C0 eps h / 4, and more of it where a flake falls out of its eddies (Csanady 1963): the time of the
    /// turbulence that it meets is T / sqrt(1 + (beta v_t / sigma_w)^2).
    SPINDRIFT_HD R relaxation(const Air<R>& air, const R& fall, const R& h) const
    {
        const R a = max(air.c0_eps, number<R>(0)) * (h * number<R>(0.25));
        if (step.crossing_squared == 0) return a;
        const R up = fma(air.s33, air.s33, fma(air.s32, air.s32, air.s31 * air.s31));
        const R crossing = R(step.crossing_squared) * (fall * fall) / max(up, number<R>(1e-12));
        return a * sqrt(number<R>(1) + min(crossing, number<R>(1e6)));
    }

    SPINDRIFT_HD Vec3<R> half_way(const Pack& p, const Vec3<R>& air, const R& half) const
    {
        return {fma(half, air.x, p.x.x), fma(half, air.y, p.x.y), fma(half, air.z - p.fall, p.x.z)};
    }

    /// Path of air plus settling plus slip; the slip decays with tau = v_t / g, and its path is exact. A
    /// flake with inertia has a velocity instead: its slip is what that exceeds the air of this step by.
    SPINDRIFT_HD void finish(const Pack& p, const Vec3<R>& air, const R& h, std::uint32_t substep,
                             Move& m) const
    {
        const Vec3<R> carried{air.x, air.y, air.z - p.fall};
        m.path = carried * h;
        m.slip = step.inertial ? p.slip - carried : p.slip;
        const R zero = number<R>(0);
        const Mask slipping = m.slip.x != zero || m.slip.y != zero || m.slip.z != zero;
        if (!none(slipping)) fade(p.fall, h, slipping, m);
        if (step.inertial) m.slip = m.slip + carried;
        if (step.fine) roll_rounding(p, substep, m.path);
    }

    SPINDRIFT_HD static void fade(const R& fall, const R& h, const Mask& slipping, Move& m)
    {
        const R tau = fall * number<R>(1.0 / kGravity);
        const R kept = exp(-(h / tau));
        const R path = tau * (number<R>(1) - kept);
        const auto one = [&](R& slip, R& along)
        {
            along = select(slipping, fma(slip, path, along), along);
            const R faded = slip * kept;
            slip = select(abs(faded) < number<R>(kLeastSlip), number<R>(0), faded);
        };
        one(m.slip.x, m.path.x);
        one(m.slip.y, m.path.y);
        one(m.slip.z, m.path.z);
    }

    /// Adds half a last place of the position either way, uniformly: the rounding of the sum is then right on
    /// average, however short the path.
    SPINDRIFT_HD void roll_rounding(const Pack& p, std::uint32_t substep, Vec3<R>& path) const
    {
        const auto words = random_words(step.seed, p.id, step.number, RandomStream::rounding, substep);
        const auto roll = [](const R& x, const UInt& word, R& along)
        {
            const R place = from_bits(bits(x) & UInt(0x7F800000U)) * number<R>(0x1p-23);
            along = fma(uniform<R>(word) - number<R>(0.5), place, along);
        };
        roll(p.x.x, words.x0, path.x);
        roll(p.x.y, words.x1, path.y);
        roll(p.x.z, words.x2, path.z);
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
        if constexpr (kOnlyFree)
            return false;
        else
        {
            meet(mask_bits(meets), from, p, m, substep, tally);
            return alive && (p.state & UInt(0xFFU)) == UInt(0U);
        }
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
        const Resolver resolve{around, step.seed, step.number, substep, Turbulent, step.inertial};
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
