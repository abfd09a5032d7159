// SPDX-License-Identifier: MIT
#include "app/frame_drawer.h"

#include <algorithm>

#include "core/error.h"
#include "cpu/tile_splatter.h"

namespace spindrift::app
{

namespace
{

bool same(const Vec3f& a, const Vec3f& b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

bool same(const View& a, const View& b)
{
    return same(a.eye, b.eye) && same(a.right, b.right) && same(a.up, b.up) && same(a.forward, b.forward) &&
           a.tan_half_fov_y == b.tan_half_fov_y && a.width_px == b.width_px && a.height_px == b.height_px &&
           a.near_m == b.near_m && a.far_m == b.far_m && a.guard_px == b.guard_px;
}

gl::GlKind gl_kind(const gl::ContextInfo& gl, const gl::FlakeBuffers& flakes)
{
    if (flakes.access() != gl::FlakeBuffers::Access::mapped) return gl::GlKind::out_of_reach;
    return gl.software ? gl::GlKind::software : gl::GlKind::hardware;
}

}  // namespace

FrameDrawer::FrameDrawer(const scene::Scene& scene, const scene::Geometry& geometry, const World& world,
                         Simulator& simulator, const gl::ContextInfo& gl, const cpu::CpuOptions& cpu,
                         StageLog& log)
    : scene_(scene),
      geometry_(geometry),
      simulator_(simulator),
      log_(log),
      brightest_emission_(scene::brightest_emission(geometry)),
      gl_(gl_kind(gl, *simulator.memory().drawn_from())),
      splatter_(cpu::make_tile_splatter(cpu)),
      renderer_(scene, geometry, world, *simulator.memory().drawn_from(), scene.render.width_px,
                scene.render.height_px, splatter_.get())
{
    if (gl_ == gl::GlKind::out_of_reach && scene.render.flake_path == scene::FlakePath::tiles)
        throw Error(
            "render.flake_path = \"tiles\": the processor blends tiles, and cannot read flakes that CUDA "
            "writes; use \"auto\" or \"raster\", or --backend cpu");
}

void FrameDrawer::set_sort(const std::string& strategy)
{
    scene_.render.sort = strategy;
    stale_ = true;
}

gl::FramePlan FrameDrawer::plan(const View& view, double time_s, const FlakeCounts& counts) const
{
    const Backend& backend = simulator_.backend();
    gl::FrameStats stats;
    stats.counts = counts;
    stats.flakes_moved = stale_ || backend.step_number() != last_step_;
    stats.camera_moved = !last_view_ || !same(view, *last_view_);
    stats.drawn = list_.count;
    stats.exposed = last_time_s_ == time_s;
    stats.brightest_emission = brightest_emission_;
    stats.shown = shown_;
    stats.shadows = shadows_;
    stats.snow_shaded = snow_shaded_;
    return gl::plan_frame(scene_, view, stats, time_s, geometry_.model_lights, gl_);
}

/// Of steps that a device has not done yet nothing is known, not even whether a flake lives: so the list is
/// made as if one did, and what prepare() has to learn anyway goes into the plan.
FlakeCounts FrameDrawer::list_flakes(const View& view, double time_s)
{
    FlakeCounts some = simulator_.backend().counts();
    some.alive = std::max<std::uint64_t>(some.alive, 1);
    const gl::FramePlan foreseen = plan(view, time_s, some);
    if (!foreseen.runs("cull")) return counts_;
    SortSettings settings = sort();
    if (!foreseen.runs("sort")) settings.strategy = "none";
    list_ = simulator_.prepare(view, settings);
    return counts_ = simulator_.backend().counts();
}

void FrameDrawer::settle_bloom()
{
    if (bloomed_ && !renderer_.found_bright())
        plans_.left_out_after_all("bloom", "nothing in the picture was bright: the chain drew nothing");
    bloomed_ = false;
}

const PlanLog& FrameDrawer::plans()
{
    settle_bloom();
    return plans_;
}

void FrameDrawer::draw(const View& view, double time_s)
{
    const FlakeCounts counts = list_flakes(view, time_s);
    const gl::FramePlan frame = plan(view, time_s, counts);
    settle_bloom();
    plans_.add(frame);
    bloomed_ = frame.runs("bloom");
    stale_ = false;
    shown_.reset();
    if (counts.alive == 0) shown_ = frame.shown;
    shadows_ = frame.lit.maps ? frame.shadows : gl::ShadowCast{};
    snow_shaded_ = frame.lit.snow;
    last_view_ = view;
    last_time_s_ = time_s;
    last_step_ = simulator_.backend().step_number();
    drawn_.push_back(static_cast<float>(list_.count));
    culled_.push_back(static_cast<float>(list_.culled));

    {
        const StageTimer timer(log_, "draw calls");
        renderer_.draw(frame, view, list_, time_s);
    }
    if (gl_ != gl::GlKind::out_of_reach)
    {
        // The next step or cull may write where GL still reads; CUDA's come behind GL by themselves.
        const StageTimer timer(log_, "wait for GL");
        renderer_.wait_for_flakes();
    }
    if (frame.still) return;
    for (const gl::PassTime& pass : renderer_.times()) log_.add("gl " + pass.name, pass.ms);
}

}  // namespace spindrift::app
