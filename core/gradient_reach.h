// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/langevin.h"
#include "core/math.h"
#include "core/number.h"
#include "core/turbulence.h"
#include "core/wind.h"
#include "core/world.h"

namespace spindrift
{

// Prepares wind cells for a step length. Host only; both backends call it on their own copy of the cells.

/// Farthest cells that are looked at, along each axis.
inline constexpr int kMostGradientReach = 64;

namespace detail
{

/// Largest of `values[i - reach … i + reach]` along one axis of a box, for every element.
inline void spread_maximum(std::vector<float>& values, std::size_t before, std::size_t along,
                           std::size_t after, int reach)
{
    if (reach <= 0 || along < 2) return;
    const auto r = static_cast<std::size_t>(reach);
    std::vector<float> line(along);
    for (std::size_t a = 0; a < after; ++a)
        for (std::size_t b = 0; b < before; ++b)
        {
            float* const first = values.data() + a * along * before + b;
            for (std::size_t i = 0; i < along; ++i) line[i] = first[i * before];
            for (std::size_t i = 0; i < along; ++i)
            {
                const std::size_t from = i > r ? i - r : 0;
                const std::size_t to = std::min(i + r + 1, along);
                first[i * before] = *std::max_element(line.data() + from, line.data() + to);
            }
        }
}

/// The most that gusts and vehicles add to the wind of a grid, m/s: three times the root mean square of gusts
/// where they are strongest, and the fastest vehicle.
inline float fastest_disturbance(const Wind& wind)
{
    float fastest = 0;
    for (const Body& body : wind.bodies)
        for (std::size_t k = 1; k < body.path.keys.size(); ++k)
        {
            const Anchor::Key &a = body.path.keys[k - 1], &b = body.path.keys[k];
            const float dx = b.position_m.x - a.position_m.x, dy = b.position_m.y - a.position_m.y;
            fastest = std::max(fastest, sqrt(dx * dx + dy * dy) / static_cast<float>(b.time_s - a.time_s));
        }
    float share = 0;
    for (const float s : wind.gust_share) share = std::max(share, s);
    return fastest + 3 * wind.gusts.speed_m_s * share;
}

inline float fastest_air(const std::vector<WindCell>& cells, bool turbulent)
{
    float fastest = 0;
    for (const WindCell& c : cells)
    {
        const float variance = std::max(
            {c.s11 * c.s11, c.s21 * c.s21 + c.s22 * c.s22, c.s31 * c.s31 + c.s32 * c.s32 + c.s33 * c.s33});
        fastest = std::max(
            fastest, std::max({abs(c.u), abs(c.v), abs(c.w)}) + (turbulent ? 3 * sqrt(variance) : 0.0F));
    }
    return fastest;
}

}  // namespace detail

/// Whether air of this World may carry a flake farther in a step than a cell of the solids is wide: at its
/// largest speed and three times its largest sigma.
inline bool steps_reach_walls(const World& world)
{
    if (world.voxels.nx == 0) return false;
    const Wind& wind = world.wind;
    const auto size = [](float a, float b, float c) { return std::max({abs(a), abs(b), abs(c)}); };
    const float u = wind.friction_velocity_m_s;
    const float logarithmic =
        u / static_cast<float>(kVonKarman) *
        static_cast<float>(log(1 + static_cast<double>(world.size_m.z / wind.roughness_m)));
    const float gusts = wind.turbulent ? 3 * static_cast<float>(kSigmaAlong) * u : 0.0F;
    float fastest = 0;
    if (wind.kind == WindKind::uniform)
        fastest = size(wind.uniform_m_s.x, wind.uniform_m_s.y, wind.uniform_m_s.z) + gusts;
    if (wind.kind == WindKind::logarithmic) fastest = logarithmic + gusts;
    if (wind.kind == WindKind::grid)
    {
        fastest = detail::fastest_air(wind.cells, wind.turbulent);
        for (const Wind::State& state : wind.later)
            fastest = std::max(fastest, detail::fastest_air(state.cells, wind.turbulent));
        fastest += detail::fastest_disturbance(wind);
    }
    return static_cast<double>(fastest) * world.step_s > static_cast<double>(world.voxels.cell_m);
}

/// In how many even parts all flakes relax in a step of h seconds, where the largest |dS/dx| anywhere is
/// `steepest_per_s`: 1 … kMostRelaxations.
inline int relaxations(double steepest_per_s, double h)
{
    const double parts = -floor(-steepest_per_s * h / kRelaxationLimit);
    return static_cast<int>(std::clamp(parts, 1.0, static_cast<double>(kMostRelaxations)));
}

/// How often flakes relax in a step: the same everywhere and at any time, as the steepest place of the World
/// asks. Where two numbers met, flakes would gather on one side of the seam, however exact each of the two
/// (docs/decisions/006-one-relaxation-cut-flow.md).
inline int relaxations(const World& world)
{
    const Wind& wind = world.wind;
    if (!wind.turbulent) return 1;
    if (wind.kind != WindKind::grid)  // steepest where the closure ends, or where the world does
    {
        const float end =
            wind.ground_m + wind.boundary_layer_m * static_cast<float>(1 - 1.01 * kLeastLayerShare);
        Air<float> air;
        sample_surface_layer(surface_layer(wind), std::min(world.size_m.z, end), air);
        return relaxations(static_cast<double>(air.gradient), world.step_s);
    }
    float steepest = 0;
    for (const WindCell& c : wind.cells) steepest = std::max(steepest, c.gradient);
    for (const Wind::State& state : wind.later)
        for (const WindCell& c : state.cells) steepest = std::max(steepest, c.gradient);
    return relaxations(static_cast<double>(steepest), world.step_s);
}

/// Replaces each cell's gradient by the largest within the reach of a flake's turbulence in `time_s`, from
/// one relaxation to the next: twice the largest sigma times that. So the sub-steps of a flake suit all that
/// it will meet.
inline void spread_gradients(WindCell* cells, int nx, int ny, int nz, const Vec3f& cell_m, double time_s)
{
    const auto x = static_cast<std::size_t>(nx);
    const auto y = static_cast<std::size_t>(ny);
    const auto z = static_cast<std::size_t>(nz);
    std::vector<float> gradient(x * y * z);
    float variance = 0;
    for (std::size_t i = 0; i < gradient.size(); ++i)
    {
        const WindCell& c = cells[i];
        gradient[i] = c.gradient;
        variance = std::max({variance, c.s11 * c.s11, c.s21 * c.s21 + c.s22 * c.s22,
                             c.s31 * c.s31 + c.s32 * c.s32 + c.s33 * c.s33});
    }
    const double reach_m = 2 * sqrt(static_cast<double>(variance)) * time_s;
    const auto reach = [&](float size_m)
    {
        const double in_cells = reach_m / static_cast<double>(size_m) + 0.5;
        return static_cast<int>(std::min(in_cells, static_cast<double>(kMostGradientReach)));
    };
    detail::spread_maximum(gradient, 1, x, y * z, reach(cell_m.x));
    detail::spread_maximum(gradient, x, y, z, reach(cell_m.y));
    detail::spread_maximum(gradient, x * y, z, 1, reach(cell_m.z));
    for (std::size_t i = 0; i < gradient.size(); ++i) cells[i].gradient = gradient[i];
}

/// Every state of a wind that changes, one behind the other and with spread gradients, and their times; both
/// empty for one that stays as it is. Mixed states keep gradients that are large enough: a mean of largest
/// values is not less than the largest of the mean.
inline std::vector<WindCell> spread_states(const World& world, std::vector<double>& times_s)
{
    std::vector<WindCell> all;
    const Wind& wind = world.wind;
    if (!wind.changes()) return all;
    const double part_s = world.step_s / relaxations(world);
    const auto add = [&](double time_s, const std::vector<WindCell>& cells)
    {
        times_s.push_back(time_s);
        all.insert(all.end(), cells.begin(), cells.end());
        if (wind.turbulent)
            spread_gradients(all.data() + all.size() - cells.size(), wind.nx, wind.ny, wind.nz, wind.cell_m,
                             part_s);
    };
    add(0, wind.cells);
    for (const Wind::State& state : wind.later) add(state.time_s, state.cells);
    return all;
}

}  // namespace spindrift
