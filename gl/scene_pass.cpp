// SPDX-License-Identifier: MIT
#include "gl/scene_pass.h"

#include <array>
#include <string_view>

#include "scene/make_world.h"

namespace spindrift::gl
{

namespace
{

constexpr std::array<std::string_view, 2> kMeshFiles{"scene.vert", "scene.frag"};
constexpr std::array<std::string_view, 2> kDepthFiles{"scene.vert", "depth_only.frag"};
constexpr GLint kOffset = 0;
constexpr GLint kAlbedo = 1;
constexpr GLint kEmission = 2;

static_assert(sizeof(scene::Vertex) == 24, "position and normal, tightly packed");

void set_material(GLuint program, const scene::Material& material)
{
    const scene::Colour& a = material.albedo;
    const scene::Colour& e = material.emission;
    glProgramUniform3f(program, kAlbedo, a.r, a.g, a.b);
    glProgramUniform3f(program, kEmission, e.r, e.g, e.b);
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
    std::vector<std::uint32_t> indices;
    for (const scene::MeshPart& part : mesh.parts)
    {
        body.parts.push_back({static_cast<GLsizei>(part.indices.size()),
                              indices.size() * sizeof(std::uint32_t),
                              mesh.materials.at(static_cast<std::size_t>(part.material))});
        indices.insert(indices.end(), part.indices.begin(), part.indices.end());
    }
    body.vertices = upload(mesh.vertices);
    body.indices = upload(indices);
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
    : program_(kMeshFiles), depth_program_(make_program(kDepthFiles)), domain_(scene.domain)
{
    for (const scene::Mesh& mesh : geometry.meshes)
        if (!mesh.vertices.empty() && !mesh.parts.empty()) bodies_.push_back(make_body(scene, mesh));
}

Vec3f ScenePass::offset_of(const Body& body, double time_s) const
{
    return body.vehicle ? scene::vehicle_at(*body.vehicle, domain_, time_s) : Vec3f{0, 0, 0};
}

void ScenePass::draw_depth(double time_s) const
{
    const GLuint program = depth_program_.name();
    glUseProgram(program);
    for (const Body& body : bodies_)
    {
        const Vec3f offset = offset_of(body, time_s);
        glProgramUniform3f(program, kOffset, offset.x, offset.y, offset.z);
        glBindVertexArray(body.array.name());
        const Part& last = body.parts.back();
        const auto indices = static_cast<GLsizei>(last.first_byte / sizeof(std::uint32_t)) + last.count;
        glDrawElements(GL_TRIANGLES, indices, GL_UNSIGNED_INT, nullptr);
    }
}

void ScenePass::draw_lit(std::size_t lights, double time_s) const
{
    const GLuint program = program_.for_lights(lights);
    glUseProgram(program);
    for (const Body& body : bodies_)
    {
        const Vec3f offset = offset_of(body, time_s);
        glProgramUniform3f(program, kOffset, offset.x, offset.y, offset.z);
        glBindVertexArray(body.array.name());
        for (const Part& part : body.parts)
        {
            set_material(program, part.material);
            glDrawElements(GL_TRIANGLES, part.count, GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(part.first_byte));
        }
    }
}

void ScenePass::draw(std::size_t lights, double time_s) const
{
    if (bodies_.empty()) return;
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GREATER);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_depth(time_s);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_EQUAL);
    draw_lit(lights, time_s);
}

}  // namespace spindrift::gl
