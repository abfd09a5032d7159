// SPDX-License-Identifier: MIT
#include "scene/drift.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/snow.h"

namespace spindrift::scene
{

namespace
{

/// u* of a wind (m/s) a distance above the ground.
double friction_of(double speed_m_s, double height_m, double roughness_m)
{
    return kVonKarman * speed_m_s / std::log((height_m + roughness_m) / roughness_m);
}

/// Of the cells of the lowest layer above the ground whose centres are over the drift, at least one.
std::vector<double> frictions(const Wind& wind, const Emitter& drift)
{
    if (wind.kind == WindKind::logarithmic) return {static_cast<double>(wind.friction_velocity_m_s)};
    const auto range = [](float low, float high, float origin, float cell, int n)
    {
        const auto index = [&](float at)
        { return std::clamp(static_cast<int>(std::lround((at - origin) / cell)), 0, n - 1); };
        return std::pair(index(low), index(high));
    };
    const auto [x0, x1] = range(drift.a.x, drift.b.x, wind.origin_m.x, wind.cell_m.x, wind.nx);
    const auto [y0, y1] = range(drift.a.y, drift.b.y, wind.origin_m.y, wind.cell_m.y, wind.ny);
    const int z = std::clamp(static_cast<int>(std::ceil((drift.a.z - wind.origin_m.z) / wind.cell_m.z)), 0,
                             wind.nz - 1);
    const double height =
        std::max(static_cast<double>(wind.origin_m.z) + z * static_cast<double>(wind.cell_m.z) -
                     static_cast<double>(drift.a.z),
                 0.25 * static_cast<double>(wind.cell_m.z));
    std::vector<double> result;
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x)
        {
            const WindCell& cell =
                wind.cells[(static_cast<std::size_t>(z) * static_cast<std::size_t>(wind.ny) +
                            static_cast<std::size_t>(y)) *
                               static_cast<std::size_t>(wind.nx) +
                           static_cast<std::size_t>(x)];
            result.push_back(friction_of(std::hypot(static_cast<double>(cell.u), static_cast<double>(cell.v)),
                                         height, static_cast<double>(wind.roughness_m)));
        }
    return result;
}

void require_ground(const World& world, std::size_t number, const Emitter& emitter)
{
    if (!world.has_ground || std::abs(emitter.a.z - world.ground_m) > 1e-3F)
        throw Error(fmt::format(
            "emitter {}: a drift stands on plane ground, but min_m is {:g} m above {}; use ground.kind = "
            "\"plane\" and its height_m in min_m",
            number, static_cast<double>(emitter.a.z - (world.has_ground ? world.ground_m : 0.0F)),
            world.has_ground ? "it" : "the lower end of the domain, and there is no ground"));
    if (world.wind.kind == WindKind::uniform)
        throw Error(fmt::format(
            "emitter {}: a drift needs a wind that has a friction velocity; use wind.source = \"log\", "
            "\"file\" or \"solve\"",
            number));
}

}  // namespace

GrainLaw set_drift(const World& world, double threshold_m_s, std::size_t number, Emitter& emitter)
{
    require_ground(world, number, emitter);
    const std::vector<double> all = frictions(world.wind, emitter);
    double strong = 0;
    std::size_t blown = 0;
    for (const double friction : all)
        if (friction > threshold_m_s) strong += friction, ++blown;
    if (blown == 0)
    {
        emitter.rate_per_s = 0, emitter.burst = 0;
        return world.grains;
    }
    strong /= static_cast<double>(blown);
    const double height = saltation(strong, threshold_m_s).height_m;
    const GrainLaw law = grain_law(height);
    double lifted = 0;
    for (const double friction : all)
        lifted += lifted_per_s(saltation(friction, threshold_m_s), law) / static_cast<double>(all.size());
    const double area =
        static_cast<double>(emitter.b.x - emitter.a.x) * static_cast<double>(emitter.b.y - emitter.a.y);
    const double flake =
        static_cast<double>(world.snow.weight) *
        mean_cross_section_m2(world.snow.spectrum, static_cast<double>(world.snow.rate_mm_h));
    emitter.rate_per_s = area * lifted / flake;
    emitter.radius_m = static_cast<float>(height);
    emitter.lift_m_s = static_cast<float>(kLiftPerFriction * strong);
    emitter.b.z = std::max(emitter.b.z, emitter.a.z + 2 * emitter.radius_m);
    return lifted_law(law);
}

}  // namespace spindrift::scene
