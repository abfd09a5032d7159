// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::reference
{

/// Where a ray meets the scene.
struct Hit
{
    double along = 0;  ///< ray parameter
    Vec3d normal{};    ///< unit, towards the ray's origin
    scene::Material material;
};

/// The solid scene in double precision, in the local frame at one display time: triangles in a tree of boxes.
class RayScene
{
  public:
    RayScene(const scene::Scene& scene, const scene::Geometry& geometry, double time_s);

    /// The first surface with `along` in [from, to]; false if there is none.
    bool first_hit(const Vec3d& origin, const Vec3d& direction, double from, double to, Hit& hit) const;

  private:
    struct Triangle
    {
        Vec3d corner, edge1, edge2;  ///< corners: corner, corner + edge1, corner + edge2
        Vec3d normal[3];
        int material;
    };
    struct Box
    {
        double low[3], high[3];
    };
    /// A leaf holds triangles [first, first + count); an inner node (count 0) has its children at first and
    /// first + 1.
    struct Node
    {
        Box box;
        std::uint32_t first, count;
    };

    void add(const scene::Mesh& mesh, const Vec3d& offset);
    void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);
    static Box box_of(const Triangle& triangle);

    std::vector<Triangle> triangles_;
    std::vector<scene::Material> materials_;
    std::vector<Node> nodes_;
};

}  // namespace spindrift::reference
