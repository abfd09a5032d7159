// SPDX-License-Identifier: MIT
#include "gl/mesh_clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace spindrift::gl
{

namespace
{

// Cells along the longest side of a mesh: fine enough to tell buildings apart, coarse enough for few calls.
constexpr float kCellsAcross = 12;

struct Box
{
    Vec3f low{std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
              std::numeric_limits<float>::max()};
    Vec3f high{-low.x, -low.y, -low.z};

    void hold(const Vec3f& p)
    {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    float longest() const { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }
};

using Cell = std::array<int, 3>;

/// Appends one cell's triangles.
void close_cluster(ClusteredMesh& out, const scene::Mesh& mesh, int material,
                   const std::vector<std::uint32_t>& indices)
{
    MeshCluster cluster{out.indices.size(), indices.size(), material, {}, 0};
    Box box;
    for (const std::uint32_t i : indices) box.hold(mesh.vertices[i].position_m);
    cluster.middle = (box.low + box.high) * 0.5F;
    const Vec3f diagonal = box.high - box.low;
    cluster.radius_m = 0.5F * std::sqrt(dot(diagonal, diagonal));
    out.indices.insert(out.indices.end(), indices.begin(), indices.end());
    out.clusters.push_back(cluster);
}

}  // namespace

ClusteredMesh gather_clusters(const scene::Mesh& mesh)
{
    Box whole;
    for (const scene::Vertex& vertex : mesh.vertices) whole.hold(vertex.position_m);
    const float cell_m = std::max(whole.longest() / kCellsAcross, 1e-6F);
    ClusteredMesh out;
    for (const scene::MeshPart& part : mesh.parts)
    {
        std::map<Cell, std::vector<std::uint32_t>> cells;
        for (std::size_t t = 0; t + 2 < part.indices.size(); t += 3)
        {
            const auto corner = [&](std::size_t k) { return mesh.vertices[part.indices[t + k]].position_m; };
            const Vec3f at = (corner(0) + corner(1) + corner(2)) * (1.0F / 3.0F) - whole.low;
            const auto cell = [&](float along) { return static_cast<int>(along / cell_m); };
            std::vector<std::uint32_t>& in_cell = cells[{cell(at.x), cell(at.y), cell(at.z)}];
            in_cell.insert(in_cell.end(), &part.indices[t], &part.indices[t] + 3);
        }
        for (const auto& [cell, indices] : cells) close_cluster(out, mesh, part.material, indices);
    }
    return out;
}

}  // namespace spindrift::gl
