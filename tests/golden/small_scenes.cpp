// SPDX-License-Identifier: MIT
#include "tests/golden/small_scenes.h"

#include <cmath>
#include <random>

namespace spindrift::golden
{

namespace
{

/// One face of a wall: corner, two edges, normal.
void add_face(scene::Mesh& mesh, const Vec3f& corner, const Vec3f& edge1, const Vec3f& edge2,
              const Vec3f& normal)
{
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3f& at : {corner, corner + edge1, corner + edge1 + edge2, corner + edge2})
        mesh.vertices.push_back({at, normal});
    for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.parts[0].indices.push_back(first + k);
}

scene::Mesh wall(const Vec3f& low, const Vec3f& high)
{
    scene::Mesh mesh;
    mesh.materials.push_back({{0.45F, 0.3F, 0.25F}, {0, 0, 0}, 1, 0});
    mesh.parts.push_back({0, {}});
    const Vec3f x{high.x - low.x, 0, 0}, y{0, high.y - low.y, 0}, z{0, 0, high.z - low.z};
    add_face(mesh, low, x, z, {0, -1, 0});
    add_face(mesh, low + y, x, z, {0, 1, 0});
    add_face(mesh, low, y, z, {-1, 0, 0});
    add_face(mesh, low + x, y, z, {1, 0, 0});
    add_face(mesh, low + z, x, y, {0, 0, 1});
    return mesh;
}

}  // namespace

void StillFlakes::add(const Vec3f& position_m, std::uint32_t serial)
{
    x.push_back(position_m.x);
    y.push_back(position_m.y);
    z.push_back(position_m.z);
    id.push_back(serial);
    state.push_back(static_cast<std::uint32_t>(Fate::alive));
}

FlakeView StillFlakes::view()
{
    FlakeView out{};
    out.x = x.data();
    out.y = y.data();
    out.z = z.data();
    out.id = id.data();
    out.state = state.data();
    return out;
}

SmallScene empty_scene()
{
    SmallScene small;
    small.scene.domain.max_m = {40, 40, 20};
    small.scene.ground.kind = scene::GroundKind::none;
    small.scene.render.width_px = small.view.width_px = 160;
    small.scene.render.height_px = small.view.height_px = 120;
    small.view.eye = {20, 2, 5};
    small.view.far_m = 200;
    small.world.size_m = {40, 40, 20};
    small.world.has_ground = false;
    small.world.seed = 0x123456789ULL;
    small.scene.seed = small.world.seed;
    return small;
}

void add_ground(SmallScene& small)
{
    small.scene.ground.kind = scene::GroundKind::plane;
    small.world.has_ground = true;
    scene::Mesh ground;
    ground.materials.push_back({small.scene.ground.albedo, {0, 0, 0}, 1, 0});
    ground.parts.push_back({0, {}});
    add_face(ground, {-500, -500, 0}, {1000, 0, 0}, {0, 1000, 0}, {0, 0, 1});
    small.geometry.meshes.push_back(ground);
}

SmallScene flakes_by_a_wall(int count)
{
    SmallScene small = empty_scene();
    add_ground(small);
    small.geometry.meshes.push_back(wall({10, 15, 0}, {18, 16, 8}));
    scene::BoxSettings box;
    box.min_m = {10, 15, 0};
    box.max_m = {18, 16, 8};
    small.scene.boxes.push_back(box);  // so that the frame plan knows of it
    std::mt19937 random(7);            // the standard fixes its numbers
    const auto unit = [&random] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
    for (int i = 0; i < count; ++i)
    {
        const float depth = 1 + 29 * unit();
        const Vec3f at{20 + (unit() - 0.5F) * 1.4F * depth, 2 + depth, 5 + (unit() - 0.5F) * 1.05F * depth};
        small.flakes.add(at, static_cast<std::uint32_t>(i) * 2654435761U);
    }
    return small;
}

void enlarge(SmallScene& small, double enlargement)
{
    small.scene.render.flake_scale = enlargement;
    small.world.snow.weight = static_cast<float>(enlargement * enlargement);
    small.scene.snow = small.world.snow;
}

void light_up(SmallScene& small)
{
    scene::Light sodium;
    sodium.kind = scene::LightKind::point;
    sodium.position_m = {24, 12, 6};
    sodium.intensity = {300, 170, 50};
    sodium.range_m = 40;

    scene::Light headlight;
    headlight.kind = scene::LightKind::spot;
    headlight.position_m = {16, 30, 2};
    headlight.direction = {0, -1, 0};
    headlight.intensity = {900, 900, 1000};
    headlight.inner_cone_deg = 10;
    headlight.outer_cone_deg = 35;

    scene::Light moon;
    moon.kind = scene::LightKind::directional;
    moon.direction = {0.6F, 0, -0.8F};
    moon.intensity = {0.8F, 0.9F, 1.2F};
    moon.g = -0.3;

    scene::Light beacon = sodium;
    beacon.position_m = {20, 6, 4};
    beacon.intensity = {80, 60, 0};
    beacon.flashing = true;
    beacon.flash_rate_hz = 2;
    beacon.flash_phase = 0.25;

    scene::Light off = sodium;
    off.on = false;
    off.intensity = {1e5F, 1e5F, 1e5F};
    scene::Light missing = off;
    missing.on = true;
    missing.exists = false;

    small.scene.lights = {sodium, headlight, moon, beacon, off, missing};
    small.scene.sky.ambient = {0.05F, 0.06F, 0.08F};
    small.scene.sky.zenith = {0.02F, 0.02F, 0.05F};
    small.scene.sky.horizon = {0.08F, 0.08F, 0.1F};
    small.time_s = 1.6;  // the beacon is on: frac(1.6 * 2 + 0.25) = 0.45
}

void thicken(SmallScene& small)
{
    scene::EmitterSettings sky;
    sky.emitter.shape = EmitterShape::sky;
    sky.a = {20, 10, 6};
    sky.b = {24, 20, 12};
    sky.emitter.burst = 2000;
    small.scene.emitters.push_back(sky);
    small.scene.air.source = scene::AirSource::visibility;
    small.scene.air.visibility_m = 45;
    if (small.scene.lights.empty()) return;
    small.scene.air.drift_visibility_m = 60;
    small.scene.air.drift_height_m = 1.2;
    small.scene.lights[0].phase = PhaseKind::double_lobe;
    small.scene.lights[0].g = 0.85;
    small.scene.lights[1].phase = PhaseKind::schlick;
}

}  // namespace spindrift::golden
