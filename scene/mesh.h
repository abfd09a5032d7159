// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/vec.h"
#include "scene/scene.h"

namespace spindrift::scene
{

struct Vertex
{
    Vec3f position_m;  ///< local frame (vehicle models: the vehicle's frame)
    Vec3f normal;      ///< unit
};

struct Material
{
    Colour albedo{0.5F, 0.5F, 0.5F};
    Colour emission{0, 0, 0};  ///< radiance, HDR
    float roughness = 1;       ///< 0..1
    float metallic = 0;        ///< 0..1
};

/// Triangles of one material.
struct MeshPart
{
    int material = 0;
    std::vector<std::uint32_t> indices;  ///< 3 per triangle, into Mesh::vertices
};

/// All that is drawn solid, and voxelised where `solid`.
struct Mesh
{
    std::vector<Vertex> vertices;
    std::vector<MeshPart> parts;
    std::vector<Material> materials;
    Surface surface;
    bool solid = true;
    std::string vehicle;  ///< not empty: moves with it
};

/// Reads a model file (OBJ, glTF 2 and what else assimp reads) into the local frame of `scene`: node
/// transforms applied, faces triangulated, missing normals made, punctual lights of the file appended to
/// `lights` (world frame). Throws Error for a missing or truncated file, no triangles, or a vertex that is
/// not finite.
Mesh read_model(const Scene& scene, const ModelSettings& settings, std::vector<Light>& lights);

/// Boxes, ground (plane or height field) and models of a scene, ready to draw, in the local frame.
struct Geometry
{
    std::vector<Mesh> meshes;
    std::vector<Light> model_lights;  ///< punctual lights that came with models, world frame
};
Geometry read_geometry(const Scene& scene);

/// Largest channel of the radiance that any surface emits.
double brightest_emission(const Geometry& geometry);

}  // namespace spindrift::scene
