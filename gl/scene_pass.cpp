// SPDX-License-Identifier: MIT
#include "gl/scene_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/surface.h"
#include "gl/lamp_lens.h"
#include "scene/make_world.h"

namespace spindrift::gl
{

namespace
{

constexpr std::array<std::string_view, 2> kMeshFiles{"scene.vert", "scene.frag"};
constexpr GLint kOffset = 0;
constexpr GLint kAlbedo = 1;
constexpr GLint kEmission = 2;
constexpr GLint kGloss = 3;
constexpr GLint kMatt = 4;

static_assert(sizeof(scene::Vertex) == 24, "position and normal, tightly packed");

bool shines(const scene::Material& material)
{
    return material.roughness < 1;
}

void set_material(GLuint program, const scene::Material& material)
{
    const scene::Colour& a = material.albedo;
    const scene::Colour& e = material.emission;
    glProgramUniform3f(program, kAlbedo, a.r, a.g, a.b);
    glProgramUniform3f(program, kEmission, e.r, e.g, e.b);
    if (!shines(material)) return;
    const Gloss<float> gloss = gloss_of(Vec3f{a.r, a.g, a.b}, material.roughness, material.metallic);
    const Vec3f m = gloss.mirrored * lobe_height(gloss.exponent);
    glProgramUniform4f(program, kGloss, m.x, m.y, m.z, gloss.exponent);
    glProgramUniform3f(program, kMatt, gloss.matt.x, gloss.matt.y, gloss.matt.z);
}

template <class T>
Buffer upload(const std::vector<T>& data)
{
    return make_buffer(static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), 0);
}

}  // namespace

ScenePass::Body ScenePass::make_body(const scene::Scene& scene, const scene::Mesh& mesh) const
{
    Body body;
    const ClusteredMesh clustered = gather_clusters(mesh);
    body.clusters = clustered.clusters;
    body.materials = mesh.materials;
    body.vertices = upload(mesh.vertices);
    body.indices = upload(clustered.indices);
    body.indices_count = static_cast<GLsizei>(clustered.indices.size());
    body.array = make_vertex_array();
    const GLuint array = body.array.name();
    glVertexArrayVertexBuffer(array, 0, body.vertices.name(), 0, sizeof(scene::Vertex));
    glVertexArrayElementBuffer(array, body.indices.name());
    for (GLuint attribute = 0; attribute < 2; ++attribute)
    {
        glEnableVertexArrayAttrib(array, attribute);
        glVertexArrayAttribFormat(array, attribute, 3, GL_FLOAT, GL_FALSE, attribute * 12);
        glVertexArrayAttribBinding(array, attribute, 0);
    }
    for (const scene::VehicleSettings& vehicle : scene.vehicles)
        if (!mesh.vehicle.empty() && vehicle.name == mesh.vehicle) body.vehicle = vehicle;
    return body;
}

ScenePass::ScenePass(const scene::Scene& scene, const scene::Geometry& geometry)
    : matt_(kMeshFiles), shiny_(kMeshFiles, {"SHINY"}), domain_(scene.domain)
{
    const float lowest_m = lowest_of(geometry);
    for (const scene::Mesh& mesh : geometry.meshes)
    {
        if (mesh.vertices.empty() || mesh.parts.empty()) continue;
        bodies_.push_back(make_body(scene, mesh));
        bodies_.back().casts = casts_shadow(mesh, lowest_m);
    }
}

Vec3f ScenePass::offset_of(const Body& body, double time_s) const
{
    return body.vehicle ? scene::vehicle_at(*body.vehicle, domain_, time_s) : Vec3f{0, 0, 0};
}

std::vector<ScenePass::Draw> ScenePass::near_to_far(const Vec3f& eye, double time_s) const
{
    std::vector<Draw> draws;
    for (const Body& body : bodies_)
    {
        const Vec3f offset = offset_of(body, time_s);
        for (const MeshCluster& cluster : body.clusters)
        {
            const Vec3f away = cluster.middle + offset - eye;
            // By the far end, so that what reaches to the horizon comes last.
            draws.push_back({&body, &cluster, offset, std::sqrt(dot(away, away)) + cluster.radius_m});
        }
    }
    std::sort(draws.begin(), draws.end(),
              [](const Draw& a, const Draw& b) { return a.farthest_m < b.farthest_m; });
    return draws;
}

void ScenePass::draw(const Vec3f& eye, const LitBy& lit, double time_s, AirKind air) const
{
    if (bodies_.empty()) return;
    glDepthFunc(GL_GREATER);
    for (const Draw& draw : near_to_far(eye, time_s))
    {
        const MeshCluster& cluster = *draw.cluster;
        const scene::Material& material = draw.body->materials.at(static_cast<std::size_t>(cluster.material));
        const GLuint program = (shines(material) ? shiny_ : matt_).in(air).for_lights(lit);
        glUseProgram(program);
        glProgramUniform3f(program, kOffset, draw.offset_m.x, draw.offset_m.y, draw.offset_m.z);
        set_material(program, material);
        glBindVertexArray(draw.body->array.name());
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(cluster.count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(cluster.first * sizeof(std::uint32_t)));
    }
}

void ScenePass::draw_casters(GLuint program, double time_s) const
{
    for (const Body& body : bodies_)
    {
        if (!body.casts) continue;
        const Vec3f offset = offset_of(body, time_s);
        glProgramUniform3f(program, kOffset, offset.x, offset.y, offset.z);
        glBindVertexArray(body.array.name());
        glDrawElements(GL_TRIANGLES, body.indices_count, GL_UNSIGNED_INT, nullptr);
    }
}

}  // namespace spindrift::gl
