// SPDX-License-Identifier: MIT
#include "reference/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/shading.h"
#include "scene/make_world.h"

namespace spindrift::reference
{

namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kLeafTriangles = 4;
/// Barycentric; no ray slips through between two triangles by rounding.
constexpr double kSlack = 1e-12;

Vec3d unit(const Vec3d& v)
{
    return v * (1 / std::sqrt(dot(v, v)));
}

/// Where a mesh stands: vehicle models move, all else lies in the local frame already.
Vec3d offset_of(const scene::Scene& scene, const scene::Mesh& mesh, double time_s)
{
    for (const scene::VehicleSettings& vehicle : scene.vehicles)
        if (!mesh.vehicle.empty() && vehicle.name == mesh.vehicle)
            return wide(scene::vehicle_at(vehicle, scene.domain, time_s));
    return {0, 0, 0};
}

}  // namespace

RayScene::RayScene(const scene::Scene& scene, const scene::Geometry& geometry, double time_s)
{
    for (const scene::Mesh& mesh : geometry.meshes) add(mesh, offset_of(scene, mesh, time_s));
    if (triangles_.empty()) return;
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(triangles_.size()));
}

void RayScene::add(const scene::Mesh& mesh, const Vec3d& offset)
{
    const int first_material = static_cast<int>(materials_.size());
    materials_.insert(materials_.end(), mesh.materials.begin(), mesh.materials.end());
    for (const scene::MeshPart& part : mesh.parts)
        for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3)
        {
            const scene::Vertex& a = mesh.vertices[part.indices[i]];
            const scene::Vertex& b = mesh.vertices[part.indices[i + 1]];
            const scene::Vertex& c = mesh.vertices[part.indices[i + 2]];
            const Vec3d corner = wide(a.position_m) + offset;
            triangles_.push_back({corner,
                                  wide(b.position_m) + offset - corner,
                                  wide(c.position_m) + offset - corner,
                                  {wide(a.normal), wide(b.normal), wide(c.normal)},
                                  first_material + part.material});
        }
}

RayScene::Box RayScene::box_of(const Triangle& triangle)
{
    const Vec3d corners[] = {triangle.corner, triangle.corner + triangle.edge1,
                             triangle.corner + triangle.edge2};
    Box box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
    for (const Vec3d& corner : corners)
    {
        const double at[] = {corner.x, corner.y, corner.z};
        for (int axis = 0; axis < 3; ++axis)
        {
            box.low[axis] = std::min(box.low[axis], at[axis]);
            box.high[axis] = std::max(box.high[axis], at[axis]);
        }
    }
    return box;
}

void RayScene::build(std::uint32_t node, std::uint32_t first, std::uint32_t count)
{
    Box box = box_of(triangles_[first]);
    for (std::uint32_t i = first + 1; i < first + count; ++i)
    {
        const Box other = box_of(triangles_[i]);
        for (int axis = 0; axis < 3; ++axis)
        {
            box.low[axis] = std::min(box.low[axis], other.low[axis]);
            box.high[axis] = std::max(box.high[axis], other.high[axis]);
        }
    }
    nodes_[node] = {box, first, count};
    if (count <= kLeafTriangles) return;

    int longest = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (box.high[axis] - box.low[axis] > box.high[longest] - box.low[longest]) longest = axis;
    const auto middle = [longest](const Triangle& triangle)
    {
        const Box around = box_of(triangle);
        return around.low[longest] + around.high[longest];
    };
    const auto begin = triangles_.begin() + first;
    const std::uint32_t half = count / 2;
    std::nth_element(begin, begin + half, begin + count,
                     [&](const Triangle& a, const Triangle& b) { return middle(a) < middle(b); });

    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].first = children;
    nodes_[node].count = 0;
    build(children, first, half);
    build(children + 1, first + half, count - half);
}

bool RayScene::first_hit(const Vec3d& origin, const Vec3d& direction, double from, double to, Hit& hit) const
{
    if (nodes_.empty()) return false;
    const double start[] = {origin.x, origin.y, origin.z};
    const double inverse[] = {1 / direction.x, 1 / direction.y, 1 / direction.z};
    const Triangle* best = nullptr;
    double best_u = 0, best_v = 0;

    std::vector<std::uint32_t> open{0};
    while (!open.empty())
    {
        const Node& node = nodes_[open.back()];
        open.pop_back();
        double enter = from, leave = to;
        for (int axis = 0; axis < 3; ++axis)
        {
            const double a = (node.box.low[axis] - start[axis]) * inverse[axis];
            const double b = (node.box.high[axis] - start[axis]) * inverse[axis];
            if (std::isnan(a) || std::isnan(b)) continue;  // the ray runs in this face of the box
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        // A flat box is as thick as rounding leaves it.
        if (enter > leave + 1e-9 * (1 + std::abs(leave))) continue;
        if (node.count == 0)
        {
            open.push_back(node.first);
            open.push_back(node.first + 1);
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        {
            // Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997; both faces.
            const Triangle& triangle = triangles_[i];
            const Vec3d p = cross(direction, triangle.edge2);
            const double determinant = dot(triangle.edge1, p);
            if (determinant == 0) continue;
            const Vec3d s = origin - triangle.corner;
            const double u = dot(s, p) / determinant;
            const Vec3d q = cross(s, triangle.edge1);
            const double v = dot(direction, q) / determinant;
            const double along = dot(triangle.edge2, q) / determinant;
            if (u < -kSlack || v < -kSlack || u + v > 1 + kSlack || along < from || along > to) continue;
            to = along;
            best = &triangle;
            best_u = u;
            best_v = v;
        }
    }
    if (best == nullptr) return false;
    const Vec3d normal =
        unit(best->normal[0] * (1 - best_u - best_v) + best->normal[1] * best_u + best->normal[2] * best_v);
    hit = {to, dot(normal, direction) > 0 ? normal * -1.0 : normal,
           materials_[static_cast<std::size_t>(best->material)]};
    return true;
}

}  // namespace spindrift::reference
