// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "scene/height_field.h"
#include "scene/mesh.h"

namespace spindrift::scene
{

namespace
{

Vec3f local(const Vec3d& world, const DomainSettings& domain)
{
    const Vec3d p = world - domain.min_m;
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// A level quad that reaches the far plane from wherever in the domain the camera stands.
Mesh ground_quad(const Scene& scene, double height_m)
{
    const Vec3d size = scene.domain.max_m - scene.domain.min_m;
    const double reach = 2 * (scene.camera.far_m + std::sqrt(size.x * size.x + size.y * size.y));
    const Vec3d middle = (scene.domain.min_m + scene.domain.max_m) * 0.5;
    Mesh mesh;
    mesh.solid = false;  // flakes meet the plane itself
    mesh.surface = scene.ground.surface;
    mesh.materials.push_back({.albedo = scene.ground.albedo});
    for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
        mesh.vertices.push_back(
            {local({middle.x + x * reach, middle.y + y * reach, height_m}, scene.domain), {0, 0, 1}});
    mesh.parts.push_back({0, {0, 1, 2, 0, 2, 3}});
    return mesh;
}

Mesh box_mesh(const BoxSettings& box, const DomainSettings& domain)
{
    Mesh mesh;
    mesh.solid = false;  // filled exactly, not by its triangles
    mesh.surface = box.surface;
    mesh.materials.push_back({.albedo = box.albedo, .emission = box.emission});
    MeshPart& part = mesh.parts.emplace_back();
    const auto corner = [&](int bits)
    {
        return local(
            {(bits & 1) != 0 ? box.max_m.x : box.min_m.x, (bits & 2) != 0 ? box.max_m.y : box.min_m.y,
             (bits & 4) != 0 ? box.max_m.z : box.min_m.z},
            domain);
    };
    struct Side
    {
        Vec3f normal;
        int corners[4];  ///< counter-clockwise from outside
    };
    static constexpr Side sides[] = {{{-1, 0, 0}, {0, 4, 6, 2}}, {{1, 0, 0}, {1, 3, 7, 5}},
                                     {{0, -1, 0}, {0, 1, 5, 4}}, {{0, 1, 0}, {2, 6, 7, 3}},
                                     {{0, 0, -1}, {0, 2, 3, 1}}, {{0, 0, 1}, {4, 5, 7, 6}}};
    for (const Side& side : sides)
    {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const int c : side.corners) mesh.vertices.push_back({corner(c), side.normal});
        part.indices.insert(part.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
    return mesh;
}

/// Under a height field the plain goes on outside of the domain, this much lower so that the two do not
/// flicker where both are level.
constexpr double kPlainBelow_m = 0.02;

}  // namespace

Geometry read_geometry(const Scene& scene)
{
    Geometry geometry;
    if (scene.ground.kind == GroundKind::plane)
        geometry.meshes.push_back(ground_quad(scene, scene.ground.height_m));
    if (scene.ground.kind == GroundKind::height_field)
    {
        geometry.meshes.push_back(ground_quad(scene, scene.ground.height_m - kPlainBelow_m));
        geometry.meshes.push_back(HeightField(scene.ground, scene.domain, scene.file.parent_path()).mesh());
    }
    for (const BoxSettings& box : scene.boxes) geometry.meshes.push_back(box_mesh(box, scene.domain));
    for (const ModelSettings& model : scene.models)
        geometry.meshes.push_back(read_model(scene, model, geometry.model_lights));
    return geometry;
}

double brightest_emission(const Geometry& geometry)
{
    float brightest = 0;
    for (const Mesh& mesh : geometry.meshes)
        for (const Material& material : mesh.materials)
            brightest =
                std::max({brightest, material.emission.r, material.emission.g, material.emission.b});
    return brightest;
}

}  // namespace spindrift::scene
