// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/light.h"
#include "core/math.h"
#include "core/vec.h"

namespace spindrift
{

// The glow of one lamp in the air on every way from one eye, in a grid, for many flakes and pixels to look up
// what core/airlight.h would integrate anew for each of them. In the words of that header, the glow of a way
// up to the angle theta is I / h times the integral of f over the angle, and f is smooth: the peak at the
// lamp is all in 1 / h and in the angle. So the grid holds the mean of f over the angle from where the lit
// part of a way begins: glow = I mean (theta - begin) / h, and only that mean is interpolated. Nodes stand at
// - rings: how far the way turns from the lamp, by the root of the chord between the two unit vectors. Ring 0
//   leads to the lamp, the last one passes it at its range, or leads away from a lamp whose range the eye is
//   in;
// - turns round the direction to the lamp, quarter by quarter at even tangents;
// - steps: squares of even shares of the angle over the lit part of the way: what lies before the lamp throws
//   its light on to the eye, in a peak.
// Only for point lamps that have a range and cast no shadow. Errors: tests/core/glow_grid_test.cpp and
// docs/decisions/032.
struct GlowGrid
{
    static constexpr int kRings = 20, kTurns = 24, kSteps = 20;
    /// Nodes: step by step, then turn by turn (the last is the first again), then ring by ring.
    static constexpr int count() { return (kRings + 1) * (kTurns + 1) * (kSteps + 1); }
};

/// The grids of a frame's lamps; not owned.
struct GlowGrids
{
    const std::int32_t* of_lamp = nullptr;  ///< number of the lamp's grid, -1: it has none; null: no lamp has
    const float* nodes = nullptr;           ///< grid by grid

    SPINDRIFT_HD const float* of(std::size_t lamp) const
    {
        if (of_lamp == nullptr || of_lamp[lamp] < 0) return nullptr;
        return nodes + static_cast<std::size_t>(of_lamp[lamp]) * GlowGrid::count();
    }
};

/// The unit vector from an eye to a lamp and two that cross it, and how far lit ways turn from it.
template <class R>
struct GlowAxes
{
    Vec3<R> to_lamp, axis, across, over;
    R widest_chord;  ///< between the axis and the unit vector of a way

    SPINDRIFT_HD GlowAxes(const Lamp<R>& lamp, const Vec3<R>& eye) : to_lamp(lamp.position_m - eye)
    {
        const R zero = number<R>(0), one = number<R>(1);
        const R away = max(sqrt(dot(to_lamp, to_lamp)), number<R>(1e-6));
        axis = to_lamp * (one / away);
        const auto upright = abs(axis.x) + abs(axis.y) < number<R>(1e-6);
        const R x = select(upright, one, axis.x), y = select(upright, zero, axis.y);
        const R level = one / sqrt(x * x + y * y);
        across = {-y * level, x * level, zero};
        over = cross(axis, across);
        // Tangent at sine = range / distance, and chord² = 2 - 2 cosine = 2 sine² / (1 + cosine).
        const R sine = lamp.range_m / away;
        const R cosine = sqrt(max(one - sine * sine, zero));
        widest_chord = select(sine < one, sine * sqrt(number<R>(2) / (one + cosine)), number<R>(2));
    }
};

/// The lit part of a way: along it, and as angles at the lamp.
template <class R>
struct GlowSpan
{
    R nearest_m, least_m;  ///< where the way passes the lamp, and how far from it
    R from_m, to_m;
    R begin, end;

    SPINDRIFT_HD GlowSpan(const Lamp<R>& lamp, const GlowAxes<R>& axes, const Vec3<R>& way)
    {
        const R zero = number<R>(0);
        nearest_m = dot(axes.to_lamp, way);
        // Not by Pythagoras: that takes large numbers from each other.
        const Vec3<R> aside = axes.to_lamp - way * nearest_m;
        const R aside2 = dot(aside, aside);
        least_m = max(sqrt(aside2), number<R>(kNearestLight_m));
        const R half = sqrt(max(lamp.range_m * lamp.range_m - aside2, zero));
        from_m = max(nearest_m - half, zero);
        to_m = max(nearest_m + half, from_m);
        begin = angle(from_m);
        end = angle(to_m);
    }
    SPINDRIFT_HD R angle(const R& at_m) const { return atan((at_m - nearest_m) / least_m); }
};

namespace detail
{

/// Between two nodes: the first one's number, and the share of the second.
template <class R>
struct GlowCell
{
    IntOf<R> node;
    R share;

    SPINDRIFT_HD GlowCell(const R& at, int intervals)
    {
        const R inside = clamp(at, number<R>(0), number<R>(intervals));
        const R low = min(floor(inside), number<R>(intervals - 1));
        node = truncate_to_int(low);
        share = inside - low;
    }
};

/// 0 to 4 once round, in quarters: half the difference of two tangents.
template <class R>
SPINDRIFT_HD R quarters(const R& across, const R& over)
{
    const R one = number<R>(1);
    const R tilt = over / max(abs(across) + abs(over), number<R>(1e-12));
    return select(across < number<R>(0), number<R>(3) - tilt, tilt + one);
}

}  // namespace detail

/// The unit vector of a ring's and turn's way.
template <class R>
SPINDRIFT_HD Vec3<R> glow_way(const GlowAxes<R>& axes, int ring, int turn)
{
    const R one = number<R>(1);
    const R root = number<R>(static_cast<double>(ring) / GlowGrid::kRings);
    const R chord = axes.widest_chord * root * root;
    const R quarter = number<R>(4.0 * turn / GlowGrid::kTurns - 1);
    const auto back = quarter > one;
    const R over = select(back, number<R>(2) - quarter, quarter);
    const R across = select(back, abs(over) - one, one - abs(over));
    const R sine = chord * sqrt(max(one - chord * chord * number<R>(0.25), number<R>(0))) /
                   sqrt(across * across + over * over);
    return axes.axis * (one - chord * chord * number<R>(0.5)) +
           (axes.across * across + axes.over * over) * sine;
}

/// Glow of a lamp of intensity 1 on the way up to `to_m`, by its grid, 1/m2 (core/airlight.h: W/(m2 sr) of
/// W/sr).
template <class R>
SPINDRIFT_HD R glow_in_grid(const float* nodes, const Lamp<R>& lamp, const Vec3<R>& eye, const Vec3<R>& way,
                            const R& to_m)
{
    const GlowAxes<R> axes(lamp, eye);
    const GlowSpan<R> span(lamp, axes, way);
    const R turned = span.angle(clamp(to_m, span.from_m, span.to_m)) - span.begin;
    const Vec3<R> chord = way - axes.axis;
    const detail::GlowCell<R> ring(
        sqrt(sqrt(dot(chord, chord)) / axes.widest_chord) * number<R>(GlowGrid::kRings), GlowGrid::kRings);
    const detail::GlowCell<R> turn(
        detail::quarters(dot(way, axes.across), dot(way, axes.over)) * number<R>(0.25 * GlowGrid::kTurns),
        GlowGrid::kTurns);
    const R whole = max(span.end - span.begin, number<R>(1e-9));
    const detail::GlowCell<R> step(sqrt(turned / whole) * number<R>(GlowGrid::kSteps), GlowGrid::kSteps);
    using Int = IntOf<R>;
    constexpr int kTurn = GlowGrid::kSteps + 1, kRing = (GlowGrid::kTurns + 1) * kTurn;
    const Int first = (ring.node * Int(GlowGrid::kTurns + 1) + turn.node) * Int(kTurn) + step.node;
    const auto along = [&](int offset)
    {
        const R low = R(gather(nodes, first + Int(offset)));
        return low + (R(gather(nodes, first + Int(offset + 1))) - low) * step.share;
    };
    const auto around = [&](int offset)
    {
        const R low = along(offset);
        return low + (along(offset + kTurn) - low) * turn.share;
    };
    const R inner = around(0);
    const R mean = inner + (around(kRing) - inner) * ring.share;
    return mean * turned / span.least_m;
}

}  // namespace spindrift
