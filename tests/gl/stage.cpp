// SPDX-License-Identifier: MIT
#include "tests/gl/stage.h"

#include <GL/glew.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/snow.h"

namespace spindrift::gl
{

namespace
{

void append_quad(scene::Mesh& mesh, const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d,
                 const Vec3f& normal)
{
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3f& corner : {a, b, c, d}) mesh.vertices.push_back({corner, normal});
    for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.parts.front().indices.push_back(first + k);
}

/// Portable pixmap: needs no library.
void keep_picture(const std::string& name, const image::Image8& picture)
{
    std::ofstream file(testing::TempDir() + "spindrift-" + name + ".ppm", std::ios::binary);
    file << "P6 " << picture.width << ' ' << picture.height << " 255\n";
    file.write(reinterpret_cast<const char*>(picture.rgb.data()),
               static_cast<std::streamsize>(picture.rgb.size()));
}

struct Drawn
{
    image::Image linear;
    image::Image8 display;
};

void place(const Stage& stage, const FlakeView& flakes, const DrawListView& list)
{
    for (std::size_t i = 0; i < stage.places.size(); ++i)
    {
        flakes.x[i] = stage.places[i].x;
        flakes.y[i] = stage.places[i].y;
        flakes.z[i] = stage.places[i].z;
        flakes.id[i] = stage.ids[i];
        list.pairs[i] = i << 32 | i;
    }
}

void fill(const Stage& stage, const FlakeBuffers& buffers)
{
    if (buffers.access() == FlakeBuffers::Access::mapped)
        return place(stage, buffers.flakes(), buffers.draw_list());
    std::vector<std::uint32_t> state(11 * buffers.array_stride());
    std::vector<std::uint64_t> lists(2 * buffers.list_stride());
    place(stage, buffers.flakes_at(state.data()), buffers.draw_list_at(lists.data()));
    glNamedBufferSubData(buffers.state_buffer(), 0, static_cast<GLsizeiptr>(state.size() * 4), state.data());
    glNamedBufferSubData(buffers.list_buffer(), 0, static_cast<GLsizeiptr>(lists.size() * 8), lists.data());
}

Drawn draw_buffers(const Stage& stage, const FlakeBuffers& buffers, const DrawList& list, double time_s)
{
    const std::string errors_before = Context::debug_errors();
    Renderer renderer(stage.scene, stage.geometry, stage.world, buffers, stage.view.width_px,
                      stage.view.height_px);
    FrameStats stats;
    stats.counts.alive = list.count;
    renderer.draw(plan_frame(stage.scene, stage.view, stats, time_s, stage.geometry.model_lights), stage.view,
                  list, time_s);
    Drawn drawn{renderer.read_linear(), renderer.read_display()};
    EXPECT_EQ(Context::debug_errors(), errors_before);
    return drawn;
}

Drawn draw_stage(const Stage& stage, double time_s, FlakeBuffers::Access access)
{
    test_context();
    const FlakeBuffers buffers(std::max<std::size_t>(stage.places.size(), 1), access);
    fill(stage, buffers);
    DrawList list;
    list.count = stage.places.size();
    list.sorted = stage.sorted;
    return draw_buffers(stage, buffers, list, time_s);
}

}  // namespace

Stage::Stage()
{
    scene.domain.max_m = {100, 100, 100};
    scene.ground.kind = scene::GroundKind::none;
    scene.sky = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    scene.display.dither = false;
    world.size_m = {100, 100, 100};
    world.has_ground = false;
    world.snow.rate_mm_h = 5;
    world.snow.weight = 1;
    scene.render.flake_opacity = 0.8;
    view.width_px = 96;
    view.height_px = 64;
    // A long lens: a flake of some millimetres fills pixels without touching the near plane's fade.
    view.tan_half_fov_y = 0.05F;
    view.near_m = 0.01F;
    view.far_m = 200;
    view.guard_px = 128;
}

double Stage::diameter_m(std::uint32_t id) const
{
    return FlakeSizes(world.snow, world.seed).diameter_m<double>(id);
}

std::uint32_t Stage::id_of_diameter(double wanted_m) const
{
    std::uint32_t best = 0;
    for (std::uint32_t id = 0; id < 20000; ++id)
        if (std::abs(diameter_m(id) - wanted_m) < std::abs(diameter_m(best) - wanted_m)) best = id;
    return best;
}

double Stage::radius_px(std::uint32_t id, double depth_m) const
{
    const double focal_px = view.height_px / (2.0 * view.tan_half_fov_y);
    return 0.5 * diameter_m(id) * scene.render.flake_scale * focal_px / depth_m;
}

void Stage::add_flake(const Vec3f& place_m, std::uint32_t id)
{
    places.push_back(place_m);
    ids.push_back(id);
}

void Stage::add_box(const Vec3f& low, const Vec3f& high, const scene::Material& material)
{
    // The plan asks the scene what is solid, the renderer the geometry.
    scene.boxes.push_back(
        {{low.x, low.y, low.z}, {high.x, high.y, high.z}, {}, material.albedo, material.emission});
    scene::Mesh mesh;
    mesh.materials.push_back(material);
    mesh.parts.emplace_back();
    const Vec3f a = low;
    const Vec3f b = high;
    append_quad(mesh, {a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}, {0, -1, 0});
    append_quad(mesh, {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}, {0, 1, 0});
    append_quad(mesh, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {a.x, b.y, b.z}, {a.x, a.y, b.z}, {-1, 0, 0});
    append_quad(mesh, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z}, {1, 0, 0});
    append_quad(mesh, {a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}, {0, 0, -1});
    append_quad(mesh, {a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}, {0, 0, 1});
    geometry.meshes.push_back(std::move(mesh));
}

image::Image Stage::draw(double time_s, FlakeBuffers::Access access) const
{
    return draw_stage(*this, time_s, access).linear;
}

image::Image Stage::draw_from(const FlakeBuffers& buffers, const DrawList& list) const
{
    return draw_buffers(*this, buffers, list, 0).linear;
}

image::Image Stage::draw_and_keep(const std::string& name, double time_s) const
{
    Drawn drawn = draw_stage(*this, time_s, FlakeBuffers::Access::mapped);
    keep_picture(name, drawn.display);
    return std::move(drawn.linear);
}

scene::Light point_light(const Vec3d& place_m, double intensity)
{
    scene::Light light;
    light.position_m = place_m;
    const auto i = static_cast<float>(intensity);
    light.intensity = {i, i, i};
    return light;
}

double total(const image::Image& image, int channel)
{
    double sum = 0;
    for (std::size_t i = static_cast<std::size_t>(channel); i < image.rgba.size(); i += 4)
        sum += image.rgba[i];
    return sum;
}

bool all_finite(const image::Image& image)
{
    return std::all_of(image.rgba.begin(), image.rgba.end(), [](float v) { return std::isfinite(v); });
}

}  // namespace spindrift::gl
