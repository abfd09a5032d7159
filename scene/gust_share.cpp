// SPDX-License-Identifier: MIT
#include "scene/gust_share.h"

#include <algorithm>
#include <cmath>

namespace spindrift::scene
{

std::vector<float> gust_share(const FlowField& flow, const GustReach& reach)
{
    constexpr double kMost = 1.5;
    const GridSize n = flow.size;
    const std::vector<float> distance = euclidean_distance(n, flow.cell_m, flow.solid);
    const double half_cell = 0.5 * std::min(flow.cell_m.x, flow.cell_m.y), z0 = reach.roughness_m;
    const double at_reference = std::log((reach.reference_height_m + z0) / z0);
    std::vector<float> share(n.count(), 0.0F);
    for (int z = 0; z < n.nz; ++z)
    {
        const double height = std::max(flow.low_m.z + (z + 0.5) * flow.cell_m.z - reach.ground_m, 0.0);
        const double level = std::min(std::log((height + z0) / z0) / at_reference, kMost);
        for (int y = 0; y < n.ny; ++y)
            for (int x = 0; x < n.nx; ++x)
            {
                const std::size_t i = n.index(x, y, z);
                if (flow.solid[i] != 0) continue;
                const double to_wall = static_cast<double>(distance[i]) - half_cell;
                share[i] = static_cast<float>(level * std::clamp(4 * to_wall / reach.length_m, 0.0, 1.0));
            }
    }
    return share;
}

Vec3f mean_at(const FlowField& flow, double height_m)
{
    const GridSize n = flow.size;
    const int z =
        std::clamp(static_cast<int>(std::floor((height_m - flow.low_m.z) / flow.cell_m.z)), 0, n.nz - 1);
    double u = 0, v = 0;
    int cells = 0;
    for (int y = 0; y < n.ny; ++y)
        for (int x = 0; x < n.nx; ++x)
            if (const std::size_t i = n.index(x, y, z); flow.solid[i] == 0)
            {
                u += static_cast<double>(flow.mean[i].x);
                v += static_cast<double>(flow.mean[i].y);
                ++cells;
            }
    if (cells == 0) return {};
    return {static_cast<float>(u / cells), static_cast<float>(v / cells), 0};
}

}  // namespace spindrift::scene
