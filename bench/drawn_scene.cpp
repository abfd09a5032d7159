// SPDX-License-Identifier: MIT
#include "bench/drawn_scene.h"

#include <GL/glew.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/snow.h"
#include "cpu/cpu_backend.h"
#include "cpu/tile_splatter.h"
#include "cpu/wind_projection.h"
#include "reference/reference.h"
#include "scene/make_world.h"

namespace spindrift::bench
{

namespace
{

scene::Scene shipped_scene(const std::string& name, std::uint64_t particles, int width_px, int height_px)
{
    scene::SceneOverrides overrides;
    overrides.particles = particles;
    overrides.width_px = width_px;
    overrides.height_px = height_px;
    return scene::read_scene(SPINDRIFT_SOURCE_DIR "/scenes/" + name + ".toml", overrides);
}

}  // namespace

DrawnScene::DrawnScene(const std::string& name, std::uint64_t particles, int width_px, int height_px)
    : DrawnScene(shipped_scene(name, particles, width_px, height_px))
{
}

DrawnScene::DrawnScene(scene::Scene scene)
    : context_(gl::make_headless_context()),
      scene_(std::move(scene)),
      geometry_(scene::read_geometry(scene_)),
      world_(scene::make_world(scene_, geometry_, cpu::project_wind())),
      buffers_(std::make_unique<gl::FlakeBuffers>(world_.capacity)),
      backend_(cpu::make_cpu_backend(world_, buffers_->flakes(), buffers_->draw_list(), {})),
      splatter_(cpu::make_tile_splatter({})),
      renderer_(std::make_unique<gl::Renderer>(scene_, geometry_, world_, *buffers_, scene_.render.width_px,
                                               scene_.render.height_px, splatter_.get()))
{
}

void DrawnScene::step()
{
    backend_->step();
    time_s_ += world_.step_s;
}

void DrawnScene::prepare()
{
    view_ = scene::camera_at(scene_, time_s_);
    gl::FrameStats stats;
    stats.counts = backend_->counts();
    stats.brightest_emission = scene::brightest_emission(geometry_);
    plan_ = gl::plan_frame(scene_, view_, stats, time_s_, geometry_.model_lights,
                           context_->info().software ? gl::GlKind::software : gl::GlKind::hardware);
    SortSettings sort;
    sort.strategy = plan_.runs("sort") ? scene_.render.sort : "none";
    sort.depth_bits = scene_.render.depth_bits;
    list_ = backend_->prepare(view_, sort);
}

void DrawnScene::draw()
{
    renderer_->draw(plan_, view_, list_, time_s_);
    glFinish();
}

void DrawnScene::draw_passes(std::initializer_list<std::string_view> names)
{
    const auto named = [&](std::string_view name)
    { return std::find(names.begin(), names.end(), name) != names.end(); };
    const bool develops_in_tiles = plan_.runs("tiles") && plan_.tone_in_tiles;
    if (develops_in_tiles && named("tone") && !named("tiles")) return;
    gl::FramePlan alone = plan_;
    for (gl::PlannedPass& pass : alone.passes)
        pass.runs = pass.runs && (named(pass.name) || pass.name == "lights" ||
                                  (develops_in_tiles && named("tiles") && pass.name == "tone"));
    renderer_->draw(alone, view_, list_, time_s_);
    glFinish();
}

std::vector<BarePoint> DrawnScene::points() const
{
    const FlakeView flakes = buffers_->flakes();
    const std::uint64_t* pairs =
        list_.in_scratch ? buffers_->draw_list().scratch : buffers_->draw_list().pairs;
    const FlakeSizes sizes(world_.snow, world_.seed);
    const float focal_px = static_cast<float>(view_.height_px) / (2 * view_.tan_half_fov_y);
    const auto scale = static_cast<float>(scene_.render.flake_scale);
    const float largest_px = std::min(view_.guard_px, 127.0F);  // docs/drawing.md
    std::vector<BarePoint> points(list_.count);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const auto slot = static_cast<std::uint32_t>(pairs[i]);
        const Vec3f away = Vec3f{flakes.x[slot], flakes.y[slot], flakes.z[slot]} - view_.eye;
        const float pixels_per_m = focal_px / dot(away, view_.forward);
        const float radius_px = std::clamp(
            0.5F * sizes.diameter_m<float>(flakes.id[slot]) * scale * pixels_per_m, 0.75F, largest_px);
        points[i].x = 0.5F * static_cast<float>(view_.width_px) + dot(away, view_.right) * pixels_per_m;
        points[i].y = 0.5F * static_cast<float>(view_.height_px) + dot(away, view_.up) * pixels_per_m;
        points[i].size_px = 2 * radius_px;
    }
    return points;
}

int DrawnScene::steps_per_frame() const
{
    return std::max(1, static_cast<int>(std::lround(1 / (scene_.render.frames_per_s * world_.step_s))));
}

image::Image DrawnScene::reference_picture() const
{
    return reference::render(scene_, geometry_, world_, buffers_->flakes(), backend_->slots_used(), view_,
                             time_s_);
}

}  // namespace spindrift::bench
