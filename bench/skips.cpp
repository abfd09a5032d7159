// SPDX-License-Identifier: MIT
#include <GL/glew.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/drawn_row.h"
#include "cpu/cpu_backend.h"
#include "cpu/tile_splatter.h"
#include "cpu/wind_projection.h"
#include "gl/context.h"
#include "gl/flake_buffers.h"
#include "gl/float_target.h"
#include "gl/frame_plan.h"
#include "gl/renderer.h"
#include "measure/timing.h"
#include "scene/make_world.h"

// Rows skip/SCENE/WHAT: what the frame plan saves by leaving something out, in scenes where it does: the same
// frame as planned and with it done all the same, in turn. Row skip/empty/clear-and-read: a scene without
// anything in it beside a clear and read-back of targets of the same size.

namespace spindrift::bench
{

using namespace measure;

namespace
{

constexpr int kSteps = 30;

/// How large a picture a row draws, and how often.
struct Effort
{
    int width_px = 1280, height_px = 720;
    std::uint64_t flakes = 100'000;
    int rounds = 15;
};

/// Lamps glow on every way in `whiteout`: a quarter of the pixels and flakes, lest a row take a minute.
Effort effort_in(std::string_view scene)
{
    if (scene == "whiteout") return {640, 360, 25'000, 7};
    return {};
}

/// What is left out, and how it is done all the same.
struct Skip
{
    const char* name;
    std::function<void(scene::Scene&)> scene;       ///< so that the plan leaves it out
    std::function<void(scene::Scene&)> done_scene;  ///< on top: so that it does not
    std::function<void(gl::FramePlan&)> done_plan;  ///< or by the plan
    bool prepares = false;                          ///< it is the draw list that is made anew
    bool has_flakes = true;
};

void nothing(scene::Scene&) {}
void as_planned(gl::FramePlan&) {}

std::function<void(gl::FramePlan&)> run(std::vector<std::string_view> names)
{
    return [names = std::move(names)](gl::FramePlan& plan)
    {
        for (gl::PlannedPass& pass : plan.passes)
            pass.runs |= std::find(names.begin(), names.end(), pass.name) != names.end();
    };
}

void switch_off(scene::Scene& scene)
{
    for (scene::Light& light : scene.lights) light.on = false;
}

/// So faint that no pixel changes, but nothing knows.
void switch_on_faintly(scene::Scene& scene)
{
    for (scene::Light& light : scene.lights)
    {
        light.on = true;
        light.intensity = {1e-30F, 1e-30F, 1e-30F};
    }
}

void clear_air(scene::Scene& scene)
{
    scene.air = {};
}

void thick_air(scene::Scene& scene)
{
    switch_off(scene);
    scene.air.source = scene::AirSource::visibility;
    scene.air.visibility_m = 150;
}

void cast_shadows(scene::Scene& scene)
{
    if (scene.lights.empty()) scene.lights.emplace_back().kind = scene::LightKind::directional;
    scene::Light& light =
        *std::find_if(scene.lights.begin(), scene.lights.end(),
                      [](const scene::Light& l) { return l.kind != scene::LightKind::point; });
    light.shadow = true;
    if (scene.boxes.empty()) scene.boxes.push_back({{8, 8, 0}, {9, 9, 3}, {}, {}, {}});
}

void cast_shadows_of_snow(scene::Scene& scene)
{
    cast_shadows(scene);
    scene.shadows.snow_slices = 8;
}

const std::vector<Skip>& skips()
{
    static const std::vector<Skip> all{
        {"lights-off", switch_off, switch_on_faintly, as_planned},
        {"list-at-rest", nothing, nothing, as_planned, true},
        {"fog-in-clear-air", clear_air, nothing, run({"fog"})},
        {"airlight-without-lamps", thick_air, nothing, run({"airlight"})},
        {"fade-where-tiles-do-it", nothing, nothing, run({"fade"})},
        {"exposure-that-is-set", nothing, nothing, run({"exposure"})},
        {"bloom-of-weight-0", [](scene::Scene& s) { s.bloom.weight = 0; }, nothing, run({"bloom"})},
        {"shadows-at-rest", cast_shadows, nothing, run({"shadows"})},
        {"snow-shade-at-rest", cast_shadows_of_snow, nothing, run({"snow shade"})},
        {"still-picture", nothing, nothing, as_planned, false, false},
    };
    return all;
}

/// A shipped scene, changed, up to the draw list of one moment.
class PlannedScene
{
  public:
    PlannedScene(const std::string& name, const std::function<void(scene::Scene&)>& change, bool has_flakes)
        : scene_(read(name)),
          geometry_((change(scene_), scene::read_geometry(scene_))),
          world_(scene::make_world(scene_, geometry_, cpu::project_wind())),
          buffers_(world_.capacity),
          backend_(cpu::make_cpu_backend(world_, buffers_.flakes(), buffers_.draw_list(), {})),
          splatter_(cpu::make_tile_splatter({})),
          renderer_(scene_, geometry_, world_, buffers_, scene_.render.width_px, scene_.render.height_px,
                    splatter_.get())
    {
        for (int i = 0; i < kSteps; ++i) backend_->step();
        time_s_ = kSteps * world_.step_s;
        view_ = scene::camera_at(scene_, time_s_);
        stats_.brightest_emission = scene::brightest_emission(geometry_);
        if (has_flakes) stats_.counts = backend_->counts();
        if (has_flakes) prepare();
        plan_ = plan();
    }

    /// What a frame at rest would do; `still`: one that need not be drawn.
    void rest(bool still)
    {
        stats_.shadows = plan_.lit.maps ? plan_.shadows : gl::ShadowCast{};
        stats_.snow_shaded = plan_.lit.snow;
        stats_.flakes_moved = stats_.camera_moved = false;
        if (still) stats_.shown = plan_.shown;
        plan_ = plan();
    }
    void prepare()
    {
        SortSettings sort;
        sort.strategy = scene_.render.sort;
        list_ = backend_->prepare(view_, sort);
    }
    void draw()
    {
        renderer_.draw(plan_, view_, list_, time_s_);
        glFinish();
    }
    void read() const { benchmark::DoNotOptimize(renderer_.read_display().rgb.data()); }
    gl::FramePlan& planned() { return plan_; }

  private:
    static scene::Scene read(const std::string& name)
    {
        scene::SceneOverrides overrides;
        const Effort effort = effort_in(name);
        if (name != "empty") overrides.particles = effort.flakes;
        overrides.width_px = effort.width_px;
        overrides.height_px = effort.height_px;
        return scene::read_scene(SPINDRIFT_SOURCE_DIR "/scenes/" + name + ".toml", overrides);
    }
    gl::FramePlan plan() const
    {
        return gl::plan_frame(scene_, view_, stats_, time_s_, geometry_.model_lights, gl::GlKind::software);
    }

    scene::Scene scene_;
    scene::Geometry geometry_;
    World world_;
    gl::FlakeBuffers buffers_;
    std::unique_ptr<Backend> backend_;
    std::unique_ptr<Splatter> splatter_;
    gl::Renderer renderer_;
    gl::FrameStats stats_;
    View view_;
    DrawList list_;
    gl::FramePlan plan_;
    double time_s_ = 0;
};

void saving(benchmark::State& state, const char* scene, const Skip& skip)
{
    const auto context = gl::make_headless_context();
    PlannedScene skipped(scene, skip.scene, skip.has_flakes);
    PlannedScene done(
        scene,
        [&](scene::Scene& s)
        {
            skip.scene(s);
            skip.done_scene(s);
        },
        skip.has_flakes);
    skipped.draw();
    done.draw();
    skipped.rest(!skip.has_flakes);
    if (skip.has_flakes) done.rest(false);
    skip.done_plan(done.planned());
    const int rounds = effort_in(scene).rounds;
    std::vector<double> with, without;
    for (int round = -2; round < rounds; ++round)
    {
        const double a = time_ms([&] { skipped.draw(); });
        const double b = time_ms(
            [&]
            {
                if (skip.prepares) done.prepare();
                done.draw();
            });
        if (round < 0) continue;
        with.push_back(a);
        without.push_back(b);
    }
    const double a = quantile(with, 0.5), b = quantile(without, 0.5);
    for (auto _ : state) state.SetIterationTime(a * 1e-3);
    state.counters["done_ms"] = b;
    state.counters["saved_ms"] = b - a;
    state.counters["saved_share"] = (b - a) / b;
    state.SetLabel(context->info().renderer);
}

void empty_scene(benchmark::State& state)
{
    const auto context = gl::make_headless_context();
    const auto bare = [](scene::Scene& s) { s.ground.kind = scene::GroundKind::none; };
    PlannedScene scene("empty", bare, false);
    const Effort effort = effort_in("empty");
    const gl::FloatTarget light(GL_RGBA16F, effort.width_px, effort.height_px),
        shown(GL_RGBA8, effort.width_px, effort.height_px);
    std::vector<unsigned char> pixels(static_cast<std::size_t>(effort.width_px) * effort.height_px * 4);
    const std::array<float, 4> black{0, 0, 0, 1};
    std::vector<double> first, still, floor;
    for (int round = -2; round < effort.rounds; ++round)
    {
        const double a = time_ms(
            [&]
            {
                scene.draw();
                scene.read();
            });
        PlannedScene& rested = scene;
        const gl::FramePlan whole = rested.planned();
        rested.rest(true);
        const double b = time_ms(
            [&]
            {
                rested.draw();
                rested.read();
            });
        rested.planned() = whole;
        const double c = time_ms(
            [&]
            {
                glClearNamedFramebufferfv(light.framebuffer.name(), GL_COLOR, 0, black.data());
                glClearNamedFramebufferfv(shown.framebuffer.name(), GL_COLOR, 0, black.data());
                glGetTextureImage(shown.texture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                                  static_cast<GLsizei>(pixels.size()), pixels.data());
            });
        if (round < 0) continue;
        first.push_back(a);
        still.push_back(b);
        floor.push_back(c);
    }
    for (auto _ : state) state.SetIterationTime(quantile(still, 0.5) * 1e-3);
    state.counters["clear_and_read_ms"] = quantile(floor, 0.5);
    state.counters["x_clear_and_read"] = quantile(still, 0.5) / quantile(floor, 0.5);
    state.counters["x_when_drawn_anew"] = quantile(first, 0.5) / quantile(floor, 0.5);
    state.SetLabel(context->info().renderer);
}

bool register_rows()
{
    for (const char* scene : {"calm", "night", "whiteout", "empty"})
        for (const Skip& skip : skips())
            add_drawn_row(std::string("skip/") + scene + "/" + skip.name,
                          [scene, &skip](benchmark::State& state) { saving(state, scene, skip); });
    add_drawn_row("skip/empty/clear-and-read", empty_scene);
    return true;
}

[[maybe_unused]] const bool registered = register_rows();

}  // namespace

}  // namespace spindrift::bench
