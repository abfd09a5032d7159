// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/flake.h"
#include "core/math.h"
#include "core/number.h"
#include "core/philox.h"
#include "core/vec.h"
#include "core/walk.h"
#include "core/wind.h"
#include "core/world.h"

namespace spindrift
{

/// Box in which the flakes of one emitter live: the domain, or the moving box of a sky.
struct Region
{
    Vec3f lower{}, upper{};
    bool sky = false;  ///< wraps on all sides and is no border of the world
};

/// Everything in a World that stands in the way of flakes, for the step at hand. Plain numbers and addresses.
struct Surroundings
{
    OnLeave on_leave = OnLeave::respawn;
    Solids solids;
    const Region* regions = nullptr;  ///< by emitter
    bool one_region = true;           ///< all emitters share regions[0]

    /// Lanes that may touch something, or leave their region, on the straight path from `from`.
    template <class R>
    SPINDRIFT_HD MaskOf<R> may_meet(const Vec3<R>& from, const Vec3<R>& path, const UIntOf<R>& state) const
    {
        return leaves_region(from + path, state) || !moves_freely(solids, from, path);
    }

    /// Whether a flake at `x` would be inside something.
    SPINDRIFT_HD bool is_blocked(const Vec3f& x) const
    {
        if (solids.has_ground && x.z < solids.ground_m) return true;
        return solids.voxels.is_solid(x);
    }

  private:
    template <class R>
    SPINDRIFT_HD MaskOf<R> leaves_region(const Vec3<R>& end, const UIntOf<R>& state) const
    {
        if (one_region) return outside(end, regions[0]);
        constexpr int width = NumberTraits<R>::width;
        std::uint32_t states[width];
        store(states, state);
        bool alike = true;
        for (int l = 1; l < width; ++l) alike = alike && (states[l] >> 8) == (states[0] >> 8);
        if (alike) return outside(end, regions[states[0] >> 8 & 0xFFU]);
        // emission fills whole runs of slots with one emitter, so that few packs come here
        MaskOf<R> out = outside(end, regions[states[0] >> 8 & 0xFFU]);
        for (int l = 1; l < width; ++l)
        {
            const MaskOf<R> mine = lane_numbers<IntOf<R>>() == IntOf<R>(l);
            out = (out && !mine) || (mine && outside(end, regions[states[l] >> 8 & 0xFFU]));
        }
        return out;
    }

    template <class R>
    SPINDRIFT_HD static MaskOf<R> outside(const Vec3<R>& x, const Region& region)
    {
        return x.x < R(region.lower.x) || x.x >= R(region.upper.x) || x.y < R(region.lower.y) ||
               x.y >= R(region.upper.y) || x.z < R(region.lower.z) || x.z >= R(region.upper.z);
    }
};

/// What one task of the host counts; the sums do not depend on how flakes were shared out. A device counts
/// with a type of its own that has the same two functions (a "Tally" below).
struct EncounterTally
{
    std::uint64_t left = 0, landed = 0, vanished = 0;
    std::uint32_t* lost = nullptr;  ///< by emitter: flakes that it is to make up for

    /// A flake came to its end; `fate` is not `alive`.
    SPINDRIFT_HD void ended(Fate fate)
    {
        ++(fate == Fate::left ? left : fate == Fate::landed ? landed : vanished);
    }
    /// A flake of this emitter is to be made up for.
    SPINDRIFT_HD void lose(std::uint32_t emitter) { ++lost[emitter]; }
};

/// One flake with the path that it would go if nothing were in the way.
struct Encounter
{
    Vec3f x, path;  ///< m
    Vec3f q, slip;
    Air<float> air;  ///< on the way; mean and S
    float fall = 0;  ///< terminal speed, m/s
    std::uint32_t id = 0, state = 0;

    SPINDRIFT_HD std::uint32_t emitter() const { return state >> 8 & 0xFFU; }
    SPINDRIFT_HD void end(Fate fate) { state = (state & ~0xFFU) | static_cast<std::uint32_t>(fate); }
};

namespace detail
{

SPINDRIFT_HD float& component(Vec3f& v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

SPINDRIFT_HD float component(const Vec3f& v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

}  // namespace detail

/// Takes flakes along their paths through walls, ground and borders: bounces, lands, leaves, wraps. One lane
/// at a time. Source: docs/physics.md "Contact".
struct EncounterResolver
{
    const Surroundings& around;
    std::uint64_t seed;
    std::uint32_t step;
    std::uint32_t substep;
    bool turbulent;
    bool inertial;  ///< Encounter::slip is the whole velocity

    /// A flake that is still under way after so many borders in one sub-step stays where the last one left
    /// it.
    static constexpr int kMostBorders = 64;
    /// Places that are tried for a flake that wrapped into a solid.
    static constexpr std::uint32_t kPlaces = 8;

    template <class Tally>
    SPINDRIFT_HD void operator()(Encounter& f, Tally& tally) const
    {
        const Region& region = around.regions[f.emitter()];
        Vec3f velocity = inertial ? f.slip : air_velocity(f) + f.slip;
        bool bounced = false;
        VoxelWalker<float> walk(around.solids);
        for (int borders = 0; borders < kMostBorders; ++borders)
        {
            Border border;
            if (!region.sky) border = next_border(f, region);
            const WalkResult<float> walked = walk(f.x, f.path * border.share);
            f.x = walked.end;
            if (walked.fate != Fate::alive) return stop(f, walked.fate, region, tally);
            f.path = f.path * (1.0F - border.share);
            const bool whole = border.share >= 1.0F;
            if (walked.bounces > 0)
            {
                bounced = true;
                reflect(f, velocity, walked);
                if (!region.sky) border = border_after_bounce(f, region, border, walked);
            }
            if (border.axis < 0 && !whole) continue;  // a bounce took it away from the border that was ahead
            if (border.axis < 0) break;
            if (!cross(f, region, border, tally)) return;
        }
        if (bounced) f.slip = inertial ? velocity : velocity - air_velocity(f);
        if (region.sky) fold(f, region, tally);
    }

  private:
    struct Border
    {
        float share = 1;  ///< of the path up to it
        int axis = -1;    ///< -1: none is crossed
        bool upper = false;
    };

    /// Of the air plus settling: what a flake without slip has.
    SPINDRIFT_HD Vec3f air_velocity(const Encounter& f) const
    {
        Vec3f v = f.air.mean;
        if (turbulent) v = v + turbulent_velocity(f.air, f.q);
        v.z -= f.fall;
        return v;
    }

    /// Ground at the lower end of the region, or above it, stops flakes before that border does.
    SPINDRIFT_HD Border next_border(const Encounter& f, const Region& region) const
    {
        Border border;
        for (int axis = 0; axis < 3; ++axis)
        {
            const float x = detail::component(f.x, axis);
            const float path = detail::component(f.path, axis);
            const float lower = detail::component(region.lower, axis);
            const float upper = detail::component(region.upper, axis);
            const bool above = x + path >= upper;
            if (!above && x + path >= lower) continue;
            if (!above && axis == 2 && around.solids.has_ground && around.solids.ground_m >= lower) continue;
            const float share = min(max(((above ? upper : lower) - x) / path, 0.0F), 1.0F);
            if (border.axis < 0 || share < border.share) border = {share, axis, above};
        }
        return border;
    }

    /// Where a flake stands that bounced on its way to `planned`, which may now lie behind it.
    SPINDRIFT_HD static Border border_after_bounce(const Encounter& f, const Region& region,
                                                   const Border& planned, const WalkResult<float>& walked)
    {
        if (planned.axis >= 0 && (walked.turned >> planned.axis & 1U) == 0) return planned;
        Border border;
        for (int axis = 0; axis < 3; ++axis)
        {
            const float x = detail::component(f.x, axis);
            if (x < detail::component(region.lower, axis)) border = {1, axis, false};
            if (x >= detail::component(region.upper, axis)) border = {1, axis, true};
        }
        return border;
    }

    /// Mirrors path and velocity with restitution, and the turbulence so that it stays well mixed (Wilson and
    /// Flesch 1993): only its normal part where no shear stress acts on the wall, else all of it.
    SPINDRIFT_HD static void reflect(Encounter& f, Vec3f& velocity, const WalkResult<float>& walked)
    {
        velocity = {velocity.x * walked.kept.x, velocity.y * walked.kept.y, velocity.z * walked.kept.z};
        const bool xy = f.air.s21 != 0;
        const bool xz = f.air.s31 != 0;
        const bool yz = f.air.s32 != 0;
        const bool shear[3] = {xy || xz, xy || yz, xz || yz};
        for (int axis = 0; axis < 3; ++axis)
        {
            if ((walked.mirrored >> axis & 1U) == 0) continue;
            detail::component(f.path, axis) *= -1.0F;
            if (shear[axis])
                f.q = {-f.q.x, -f.q.y, -f.q.z};
            else
                detail::component(f.q, axis) *= -1.0F;
        }
    }

    template <class Tally>
    SPINDRIFT_HD static void stop(Encounter& f, Fate fate, const Region& region, Tally& tally)
    {
        f.end(fate);
        tally.ended(fate);
        if (region.sky) tally.lose(f.emitter());
    }

    /// At the border of the domain. False if the flake is gone.
    template <class Tally>
    SPINDRIFT_HD bool cross(Encounter& f, const Region& region, const Border& border, Tally& tally) const
    {
        if (around.on_leave != OnLeave::wrap || border.axis == 2)
        {
            f.end(Fate::left);
            tally.ended(Fate::left);
            if (around.on_leave == OnLeave::respawn) tally.lose(f.emitter());
            return false;
        }
        const float lower = detail::component(region.lower, border.axis);
        const float upper = detail::component(region.upper, border.axis);
        detail::component(f.x, border.axis) = border.upper ? lower : below(lower, upper);
        return settle_in(f, region, border.axis == 0, border.axis == 1, tally);
    }

    /// Brings a flake that left the box of its sky in again on the other side.
    template <class Tally>
    SPINDRIFT_HD void fold(Encounter& f, const Region& region, Tally& tally) const
    {
        bool folded[3] = {false, false, false};
        for (int axis = 0; axis < 3; ++axis)
        {
            float& x = detail::component(f.x, axis);
            const float lower = detail::component(region.lower, axis);
            const float upper = detail::component(region.upper, axis);
            if (x >= lower && x < upper) continue;
            const float turns = (x - lower) / (upper - lower);
            x = lower + (turns - floor(turns)) * (upper - lower);
            if (!(x >= lower && x < upper)) x = lower;
            folded[axis] = true;
        }
        if (folded[0] || folded[1] || folded[2]) settle_in(f, region, folded[0], folded[1], tally);
    }

    /// A flake that wrapped into a solid is tried at other places of the side where it came in, at the same
    /// height; it vanishes if none of them is free. False if it is gone.
    template <class Tally>
    SPINDRIFT_HD bool settle_in(Encounter& f, const Region& region, bool keep_x, bool keep_y,
                                Tally& tally) const
    {
        if (!around.is_blocked(f.x)) return true;
        f.path = {0, 0, 0};
        const bool keep_none = keep_x && keep_y;
        for (std::uint32_t place = 0; place < kPlaces; ++place)
        {
            const auto words = random_words<std::uint32_t>(seed, f.id, step, RandomStream::respawn,
                                                           substep * kPlaces + place);
            if (!keep_x || keep_none)
                f.x.x = between(region.lower.x, region.upper.x, uniform<float>(words.x0));
            if (!keep_y || keep_none)
                f.x.y = between(region.lower.y, region.upper.y, uniform<float>(words.x1));
            if (!around.is_blocked(f.x)) return true;
        }
        stop(f, Fate::vanished, region, tally);
        return false;
    }

    SPINDRIFT_HD static float between(float lower, float upper, float share)
    {
        return min(fma(share, upper - lower, lower), below(lower, upper));
    }

    /// The largest number of [lower, upper).
    SPINDRIFT_HD static float below(float lower, float upper)
    {
        const float step_down = max(abs(lower), abs(upper)) * 0x1p-23F;
        return max(upper - step_down, lower);
    }
};

}  // namespace spindrift
