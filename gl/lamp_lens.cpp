// SPDX-License-Identifier: MIT
#include "gl/lamp_lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/make_world.h"

namespace spindrift::gl
{

namespace
{

constexpr float kMost = std::numeric_limits<float>::max();
constexpr CasterBox kNothing{{kMost, kMost, kMost}, {-kMost, -kMost, -kMost}};
/// A map is a little larger than what it covers: rounding must not cut its rim.
constexpr float kMargin = 1.01F;

void hold(CasterBox& box, const Vec3f& p)
{
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

std::array<Vec3f, 8> corners_of(const CasterBox& box)
{
    std::array<Vec3f, 8> corners{};
    for (std::size_t i = 0; i < 8; ++i)
        corners[i] = {i & 1U ? box.high.x : box.low.x, i & 2U ? box.high.y : box.low.y,
                      i & 4U ? box.high.z : box.low.z};
    return corners;
}

/// Orthonormal axes across the way of a light.
struct Axes
{
    Vec3f right, up, forward;
};

Axes axes_along(const Vec3f& forward)
{
    const Vec3f aside = std::abs(forward.z) < 0.9F ? Vec3f{0, 0, 1} : Vec3f{0, 1, 0};
    const Vec3f right = cross(forward, aside);
    const Vec3f unit = right * (1 / std::sqrt(dot(right, right)));
    return {unit, cross(unit, forward), forward};
}

/// dot(axis, place - origin) * scale + offset
void set_row(float (&row)[4], const Vec3f& axis, const Vec3f& origin, float scale, float offset)
{
    row[0] = axis.x * scale;
    row[1] = axis.y * scale;
    row[2] = axis.z * scale;
    row[3] = offset - dot(axis, origin) * scale;
}

struct Span
{
    float low = kMost, high = -kMost;
    float length() const { return std::max(high - low, 1e-3F); }
    float middle() const { return 0.5F * (low + high); }
};

Span span_of(const CasterBox& box, const Vec3f& axis)
{
    Span span;
    for (const Vec3f& corner : corners_of(box))
    {
        span.low = std::min(span.low, dot(axis, corner));
        span.high = std::max(span.high, dot(axis, corner));
    }
    return span;
}

LampLens parallel_lens(const Vec3f& way, const CasterBox& box, int px)
{
    const Axes axes = axes_along(way);
    const Span x = span_of(box, axes.right), y = span_of(box, axes.up), z = span_of(box, axes.forward);
    // Square texels: one number says how far a surface must be moved off itself.
    const float side = kMargin * std::max(x.length(), y.length());
    const Vec3f none{0, 0, 0};
    LampLens lens;
    set_row(lens.across, axes.right, none, 1 / side, 0.5F - x.middle() / side);
    set_row(lens.up, axes.up, none, 1 / side, 0.5F - y.middle() / side);
    set_row(lens.depth, axes.forward, none, 1 / z.length(), -z.low / z.length());
    set_row(lens.width, none, none, 0, 1);
    lens.texel_m = side / static_cast<float>(px);
    return lens;
}

/// Without its depth.
LampLens spot_lens(const Lamp<float>& lamp, const Axes& axes, int px)
{
    const float tangent =
        kMargin * std::sqrt(std::max(1 - lamp.cos_outer * lamp.cos_outer, 0.0F)) / lamp.cos_outer;
    LampLens lens;
    const auto centred = [&](float(&row)[4], const Vec3f& axis)
    {
        const Vec3f both = axis * (0.5F / tangent) + axes.forward * 0.5F;
        set_row(row, both, lamp.position_m, 1, 0);
    };
    centred(lens.across, axes.right);
    centred(lens.up, axes.up);
    set_row(lens.width, axes.forward, lamp.position_m, 1, 0);
    lens.texel_m = 2 * tangent / static_cast<float>(px);
    return lens;
}

float farthest_of(const Lamp<float>& lamp, const Axes& axes, const CasterBox& box)
{
    const float far_m = span_of(box, axes.forward).high - dot(axes.forward, lamp.position_m);
    return std::max(std::min(far_m, lamp.range_m), 1.0F);
}

bool same(const Vec3f& a, const Vec3f& b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

bool same_map(const Lamp<float>& a, const Lamp<float>& b)
{
    return a.kind == b.kind && same(a.position_m, b.position_m) && same(a.direction, b.direction) &&
           a.range_m == b.range_m && a.cos_outer == b.cos_outer;
}

const scene::VehicleSettings* vehicle_of(const scene::Scene& scene, const std::string& name)
{
    const auto found = std::find_if(scene.vehicles.begin(), scene.vehicles.end(),
                                    [&](const scene::VehicleSettings& v) { return v.name == name; });
    return name.empty() || found == scene.vehicles.end() ? nullptr : &*found;
}

}  // namespace

float lowest_of(const scene::Geometry& geometry)
{
    float lowest = kMost;
    for (const scene::Mesh& mesh : geometry.meshes)
        if (mesh.vehicle.empty())
            for (const scene::Vertex& vertex : mesh.vertices) lowest = std::min(lowest, vertex.position_m.z);
    return lowest;
}

bool casts_shadow(const scene::Mesh& mesh, float lowest_m)
{
    return !mesh.vehicle.empty() ||
           std::any_of(mesh.vertices.begin(), mesh.vertices.end(),
                       [&](const scene::Vertex& vertex) { return vertex.position_m.z > lowest_m; });
}

CasterBox casters_of(const scene::Scene& scene, const scene::Geometry& geometry)
{
    const float lowest_m = lowest_of(geometry);
    CasterBox box = kNothing;
    for (const scene::Mesh& mesh : geometry.meshes)
    {
        if (!casts_shadow(mesh, lowest_m)) continue;
        CasterBox own = kNothing;
        for (const scene::Vertex& vertex : mesh.vertices) hold(own, vertex.position_m);
        if (own.empty()) continue;
        std::vector<Vec3f> places{{0, 0, 0}};
        if (const scene::VehicleSettings* vehicle = vehicle_of(scene, mesh.vehicle))
        {
            places.clear();
            for (const scene::VehicleSettings::Key& key : vehicle->path.keys)
                places.push_back(scene::vehicle_at(*vehicle, scene.domain, key.time_s));
        }
        for (const Vec3f& place : places)
        {
            hold(box, own.low + place);
            hold(box, own.high + place);
        }
    }
    const Vec3d size = scene.domain.max_m - scene.domain.min_m;
    const CasterBox domain{
        {0, 0, 0}, {static_cast<float>(size.x), static_cast<float>(size.y), static_cast<float>(size.z)}};
    if (box.empty()) return domain;  // a map is looked up all the same
    box.low = {std::max(box.low.x, 0.0F), std::max(box.low.y, 0.0F), std::max(box.low.z, lowest_m)};
    box.high.x = std::min(box.high.x, domain.high.x);
    box.high.y = std::min(box.high.y, domain.high.y);
    return box.empty() || box.low.y > box.high.y ? domain : box;
}

LampLens map_lens(const Lamp<float>& lamp, const CasterBox& box, int px)
{
    if (lamp.kind == LampKind::directional) return parallel_lens(lamp.direction, box, px);
    const Axes axes = axes_along(lamp.direction);
    LampLens lens = spot_lens(lamp, axes, px);
    const auto near_m = static_cast<float>(kShadowNearest_m);
    const float far_m = std::max(farthest_of(lamp, axes, box), 2 * near_m);
    const float scale = far_m / (far_m - near_m);
    set_row(lens.depth, axes.forward, lamp.position_m, scale, -near_m * scale);
    return lens;
}

LampLens snow_lens(const Lamp<float>& lamp, const CasterBox& box, int px)
{
    if (lamp.kind == LampKind::directional) return parallel_lens(lamp.direction, box, px);
    const Axes axes = axes_along(lamp.direction);
    LampLens lens = spot_lens(lamp, axes, px);
    set_row(lens.depth, axes.forward, lamp.position_m, 1 / farthest_of(lamp, axes, box), 0);
    return lens;
}

bool ShadowCast::operator==(const ShadowCast& other) const
{
    return std::equal(lamps.begin(), lamps.end(), other.lamps.begin(), other.lamps.end(), same_map) &&
           std::equal(vehicles.begin(), vehicles.end(), other.vehicles.begin(), other.vehicles.end(),
                      [](const Vec3f& a, const Vec3f& b) { return same(a, b); });
}

ShadowCast shadow_cast(const scene::Scene& scene, const std::vector<Lamp<float>>& lamps, double time_s)
{
    ShadowCast cast;
    std::copy_if(lamps.begin(), lamps.end(), std::back_inserter(cast.lamps),
                 [](const Lamp<float>& lamp) { return lamp.casts_shadow; });
    for (const scene::ModelSettings& model : scene.models)
        if (const scene::VehicleSettings* vehicle = vehicle_of(scene, model.vehicle))
            cast.vehicles.push_back(scene::vehicle_at(*vehicle, scene.domain, time_s));
    return cast;
}

}  // namespace spindrift::gl
