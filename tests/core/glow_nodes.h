// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/airlight.h"
#include "core/glow_grid.h"

namespace spindrift
{

/// Glow of a lamp of intensity 1 from the part [from, to] of a way, in double, cut at the flakes' volume.
inline double glow_of_part(const AirPath<double>& path, const Lamp<double>& lamp, double from_m, double to_m)
{
    const double in = std::clamp(path.enters_m, from_m, to_m), out = std::clamp(path.leaves_m, from_m, to_m);
    double sum = 0;
    if (in > from_m) sum += airlight(path, lamp, from_m, in).x;
    if (out > in) sum += airlight(path, lamp, in, out).x;
    if (to_m > out) sum += airlight(path, lamp, out, to_m).x;
    return sum / lamp.intensity.x;
}

/// The nodes of a lamp's grid, each integrated in double by eight points a step. `path_of`: the way through
/// the air of a unit vector.
template <class PathOf>
std::vector<float> glow_nodes(const Lamp<double>& lamp, const Vec3d& eye, const PathOf& path_of)
{
    const GlowAxes<double> axes(lamp, eye);
    std::vector<float> nodes;
    for (int ring = 0; ring <= GlowGrid::kRings; ++ring)
        for (int turn = 0; turn <= GlowGrid::kTurns; ++turn)
        {
            const Vec3d way = glow_way(axes, ring, turn);
            const AirPath<double> path = path_of(way);
            const GlowSpan<double> span(lamp, axes, way);
            const double whole = std::max(span.end - span.begin, 1e-9);
            const auto at = [&](double share)
            {
                const double angle = span.begin + whole * share;
                return std::clamp(span.nearest_m + span.least_m * std::tan(angle), span.from_m, span.to_m);
            };
            const auto mean = [&](double sum, double share) { return sum * span.least_m / (whole * share); };
            constexpr double kTiny = 1e-3;
            nodes.push_back(
                static_cast<float>(mean(glow_of_part(path, lamp, span.from_m, at(kTiny)), kTiny)));
            double sum = 0;
            for (int step = 1; step <= GlowGrid::kSteps; ++step)
            {
                const double before = std::pow((step - 1.0) / GlowGrid::kSteps, 2);
                const double share = std::pow(static_cast<double>(step) / GlowGrid::kSteps, 2);
                sum += glow_of_part(path, lamp, at(before), at(share));
                nodes.push_back(static_cast<float>(mean(sum, share)));
            }
        }
    return nodes;
}

}  // namespace spindrift
