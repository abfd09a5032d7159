// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/gusts.h"
#include "core/regions.h"
#include "core/vehicle_wake.h"
#include "core/wind_states.h"

namespace spindrift
{

/// A Body without ownership.
struct BodyView
{
    AnchorView path;
    Vec3f size_m{};
};

/// All that makes the wind of a grid change from step to step: its states, gusts and vehicles. Plain
/// addresses. Each step runs three parts one behind the other: place_bodies once, stream for each of
/// stream_points(), then cell for each cell of states.
struct BlownWind
{
    WindStates states;
    int nx = 0, ny = 0, nz = 0;
    Vec3f origin_m{}, cell_m{1, 1, 1};
    GustPattern gusts;
    const float* gust_share = nullptr;
    float* stream_m2_s = nullptr;  ///< psi of the columns and of one more all round; null: no gusts
    const BodyView* bodies = nullptr;
    MovingBody* moving = nullptr;
    std::size_t body_count = 0;
    double step_s = 0;

    std::size_t stream_points() const
    {
        return stream_m2_s == nullptr
                   ? 0
                   : (static_cast<std::size_t>(nx) + 2) * (static_cast<std::size_t>(ny) + 2);
    }

    /// A step sees the wind of its middle.
    SPINDRIFT_HD double time_of(std::uint64_t step) const
    {
        return (static_cast<double>(step) + 0.5) * step_s;
    }

    SPINDRIFT_HD void place_bodies(std::uint64_t step) const
    {
        for (std::size_t i = 0; i < body_count; ++i) moving[i] = place(bodies[i], time_of(step));
    }

    SPINDRIFT_HD void stream(std::uint64_t step, std::size_t i) const
    {
        const std::size_t row = static_cast<std::size_t>(nx) + 2;
        const auto at = [](float origin, float cell, std::size_t n)
        { return static_cast<double>(origin) + static_cast<double>(cell) * (static_cast<double>(n) - 1); };
        stream_m2_s[i] =
            gusts.stream(at(origin_m.x, cell_m.x, i % row), at(origin_m.y, cell_m.y, i / row), time_of(step));
    }

    SPINDRIFT_HD void cell(const WindMoment& moment, std::size_t i) const
    {
        mix_cell(states, moment, i);
        WindCell& now = states.now[i];
        const auto x = static_cast<int>(i % static_cast<std::size_t>(nx));
        const auto y = static_cast<int>(i / static_cast<std::size_t>(nx) % static_cast<std::size_t>(ny));
        if (stream_m2_s != nullptr) add_gust(x, y, i, now);
        if (body_count == 0 || gust_share[i] == 0) return;
        const auto z = static_cast<int>(i / static_cast<std::size_t>(nx) / static_cast<std::size_t>(ny));
        const Vec3f centre{centre_of(origin_m.x, cell_m.x, x), centre_of(origin_m.y, cell_m.y, y),
                           centre_of(origin_m.z, cell_m.z, z)};
        for (std::size_t b = 0; b < body_count; ++b)
        {
            if (!(moving[b].frontal_m2 > 0)) continue;
            const Vec3f wake = vehicle_wake(moving[b], centre);
            now.u = now.u + wake.x;
            now.v = now.v + wake.y;
            now.w = now.w + wake.z;
        }
    }

  private:
    SPINDRIFT_HD static float centre_of(float origin, float cell, int n)
    {
        return fma(cell, static_cast<float>(n), origin);
    }

    /// Central differences of psi times share, one layer for itself: free of divergence, and along walls at
    /// walls.
    SPINDRIFT_HD void add_gust(int x, int y, std::size_t i, WindCell& now) const
    {
        const float own = gust_share[i];
        if (own == 0) return;
        const auto row = static_cast<std::size_t>(nx);
        const float east = x + 1 < nx ? gust_share[i + 1] : own;
        const float west = x > 0 ? gust_share[i - 1] : own;
        const float north = y + 1 < ny ? gust_share[i + row] : own;
        const float south = y > 0 ? gust_share[i - row] : own;
        const float* const psi =
            stream_m2_s + (static_cast<std::size_t>(y) + 1) * (row + 2) + static_cast<std::size_t>(x) + 1;
        const float half = 0.5F;
        now.u = now.u + (psi[row + 2] * north - *(psi - row - 2) * south) * (half / cell_m.y);
        now.v = now.v - (psi[1] * east - *(psi - 1) * west) * (half / cell_m.x);
    }

    /// Its speed is that of its path; the air's is taken where its middle is, from the state before.
    SPINDRIFT_HD MovingBody place(const BodyView& body, double time_s) const
    {
        constexpr double kShort_s = 1.0 / 128;
        const Vec3f before = body.path.at(time_s - kShort_s), after = body.path.at(time_s + kShort_s);
        const float per_s = static_cast<float>(0.5 / kShort_s);
        const float vx = (after.x - before.x) * per_s, vy = (after.y - before.y) * per_s;
        const float speed = sqrt(vx * vx + vy * vy);
        MovingBody now;
        now.place = body.path.at(time_s);
        if (!(speed > 0)) return now;
        now.to_x = vx / speed;
        now.to_y = vy / speed;
        const Vec3f middle{now.place.x, now.place.y, now.place.z + 0.5F * body.size_m.z};
        const WindCell& air =
            states.states[moment_of(states, time_s).before * states.cells + cell_at(middle)];
        now.excess_m_s = speed - (air.u * now.to_x + air.v * now.to_y);
        now.length_m = body.size_m.x;
        now.frontal_m2 = body.size_m.y * body.size_m.z;
        return now;
    }

    SPINDRIFT_HD std::size_t cell_at(const Vec3f& p) const
    {
        const auto axis = [](float at, float origin, float cell, int n)
        {
            const float i = min(max((at - origin) / cell + 0.5F, 0.0F), static_cast<float>(n - 1));
            return static_cast<std::size_t>(truncate_to_int(i));
        };
        return (axis(p.z, origin_m.z, cell_m.z, nz) * static_cast<std::size_t>(ny) +
                axis(p.y, origin_m.y, cell_m.y, ny)) *
                   static_cast<std::size_t>(nx) +
               axis(p.x, origin_m.x, cell_m.x, nx);
    }
};

/// All but the addresses. Host only.
inline BlownWind blown_wind(const Wind& wind, double step_s)
{
    BlownWind blown;
    blown.nx = wind.nx, blown.ny = wind.ny, blown.nz = wind.nz;
    blown.origin_m = wind.origin_m, blown.cell_m = wind.cell_m;
    blown.gusts = gust_pattern(wind.gusts);
    blown.body_count = wind.bodies.size();
    blown.step_s = step_s;
    return blown;
}

}  // namespace spindrift
