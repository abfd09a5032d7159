// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "gl/lit_program.h"
#include "gl/mesh_clusters.h"
#include "gl/object.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// Draws the solid things; meshes on vehicles at their place, near to far by cluster.
class ScenePass
{
  public:
    ScenePass(const scene::Scene& scene, const scene::Geometry& geometry);
    void draw(const Vec3f& eye, const LitBy& lit, double time_s, AirKind air) const;
    /// Only what casts shadows, by a program whose uniform 0 is the place of its vehicle.
    void draw_casters(GLuint program, double time_s) const;

  private:
    struct Body
    {
        Buffer vertices, indices;
        VertexArray array;
        std::vector<MeshCluster> clusters;
        GLsizei indices_count = 0;
        bool casts = true;  ///< shadows
        std::vector<scene::Material> materials;
        std::optional<scene::VehicleSettings> vehicle;
    };
    /// One call of a frame.
    struct Draw
    {
        const Body* body;
        const MeshCluster* cluster;
        Vec3f offset_m;
        float farthest_m;
    };
    std::vector<Draw> near_to_far(const Vec3f& eye, double time_s) const;
    Vec3f offset_of(const Body& body, double time_s) const;
    Body make_body(const scene::Scene& scene, const scene::Mesh& mesh) const;

    ByAir matt_, shiny_;
    std::vector<Body> bodies_;
    scene::DomainSettings domain_;
};

}  // namespace spindrift::gl
