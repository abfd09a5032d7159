// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"
#include "scene/mesh.h"

namespace spindrift::gl
{

/// Triangles of one material that lie together: what is drawn with one call.
struct MeshCluster
{
    std::size_t first = 0;  ///< into ClusteredMesh::indices
    std::size_t count = 0;
    int material = 0;
    Vec3f middle{};  ///< of the box that holds it
    float radius_m = 0;
};

/// A mesh whose triangles are gathered by place, so that they can be drawn near to far: what is hidden then
/// fails the depth test before it is lit.
struct ClusteredMesh
{
    std::vector<std::uint32_t> indices;
    std::vector<MeshCluster> clusters;
};

ClusteredMesh gather_clusters(const scene::Mesh& mesh);

}  // namespace spindrift::gl
