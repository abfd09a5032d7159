// SPDX-License-Identifier: MIT
#include "app/frame_drawer.h"

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

}  // namespace

FrameDrawer::FrameDrawer(const scene::Scene& scene, const scene::Geometry& geometry, const World& world,
                         Simulator& simulator, const gl::ContextInfo& gl, StageLog& log)
    : scene_(scene),
      geometry_(geometry),
      simulator_(simulator),
      log_(log),
      gl_(gl.software ? gl::GlKind::software : gl::GlKind::hardware),
      splatter_(cpu::make_tile_splatter(simulator.options())),
      renderer_(scene, geometry, world, *simulator.memory().drawn_from(), scene.render.width_px,
                scene.render.height_px, splatter_.get())
{
}

void FrameDrawer::set_sort(const std::string& strategy)
{
    scene_.render.sort = strategy;
    stale_ = true;
}

gl::FramePlan FrameDrawer::plan(const View& view, double time_s) const
{
    const Backend& backend = simulator_.backend();
    gl::FrameStats stats;
    stats.counts = backend.counts();
    stats.flakes_moved = stale_ || backend.step_number() != last_step_;
    stats.camera_moved = !last_view_ || !same(view, *last_view_);
    stats.drawn = list_.count;
    return gl::plan_frame(scene_, view, stats, time_s, geometry_.model_lights, gl_);
}

void FrameDrawer::draw(const View& view, double time_s)
{
    const gl::FramePlan frame = plan(view, time_s);
    plans_.add(frame);
    if (frame.runs("cull"))
        list_ = simulator_.prepare(
            view, {frame.runs("sort") ? scene_.render.sort : "none", scene_.render.depth_bits});
    else if (simulator_.backend().counts().alive == 0)
        list_ = {};
    stale_ = false;
    last_view_ = view;
    last_step_ = simulator_.backend().step_number();
    drawn_.push_back(static_cast<float>(list_.count));
    culled_.push_back(static_cast<float>(list_.culled));

    {
        const StageTimer timer(log_, "draw calls");
        renderer_.draw(frame, view, list_, time_s);
    }
    {
        // The next step or cull may write where GL still reads.
        const StageTimer timer(log_, "wait for GL");
        renderer_.wait_for_flakes();
    }
    for (const gl::PassTime& pass : renderer_.times()) log_.add("gl " + pass.name, pass.ms);
}

}  // namespace spindrift::app
