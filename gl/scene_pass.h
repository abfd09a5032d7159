// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "gl/lit_program.h"
#include "gl/object.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// Draws the solid things; meshes on vehicles at their place. Depth first, so that light is computed once a
/// pixel.
class ScenePass
{
  public:
    ScenePass(const scene::Scene& scene, const scene::Geometry& geometry);
    void draw(std::size_t lights, double time_s) const;

  private:
    struct Part
    {
        GLsizei count;
        std::size_t first_byte;
        scene::Material material;
    };
    struct Body
    {
        Buffer vertices, indices;
        VertexArray array;
        std::vector<Part> parts;
        std::optional<scene::VehicleSettings> vehicle;
    };
    void draw_depth(double time_s) const;
    void draw_lit(std::size_t lights, double time_s) const;
    Vec3f offset_of(const Body& body, double time_s) const;
    Body make_body(const scene::Scene& scene, const scene::Mesh& mesh) const;

    LitProgram program_;
    Program depth_program_;
    std::vector<Body> bodies_;
    scene::DomainSettings domain_;
};

}  // namespace spindrift::gl
