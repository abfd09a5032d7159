// SPDX-License-Identifier: MIT
#include "app/frame_drawer.h"

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

/// Lamps that come with models count for the plan as the scene's own do.
scene::Scene with_model_lights(scene::Scene scene, const scene::Geometry& geometry)
{
    scene.lights.insert(scene.lights.end(), geometry.model_lights.begin(), geometry.model_lights.end());
    return scene;
}

}  // namespace

FrameDrawer::FrameDrawer(const scene::Scene& scene, const scene::Geometry& geometry, const World& world,
                         Simulator& simulator, StageLog& log)
    : planned_scene_(with_model_lights(scene, geometry)),
      simulator_(simulator),
      log_(log),
      renderer_(scene, geometry, world, *simulator.memory().drawn_from(), scene.render.width_px,
                scene.render.height_px),
      sort_{scene.render.sort, scene.render.depth_bits}
{
}

void FrameDrawer::set_sort(const std::string& strategy)
{
    sort_.strategy = strategy;
}

bool FrameDrawer::list_is_valid(const gl::FrameStats& stats, const std::string& strategy) const
{
    return last_view_ && !stats.flakes_moved && !stats.camera_moved && strategy == list_strategy_;
}

void FrameDrawer::draw(const View& view, double time_s)
{
    const Backend& backend = simulator_.backend();
    gl::FrameStats stats;
    stats.counts = backend.counts();
    stats.flakes_moved = !last_view_ || backend.step_number() != last_step_;
    stats.camera_moved = !last_view_ || !same(view, *last_view_);
    stats.drawn = list_.count;
    const gl::FramePlan plan = gl::plan_frame(planned_scene_, view, stats, time_s);
    plans_.add(plan);

    const bool at_rest = last_view_ && !stats.flakes_moved && !stats.camera_moved;
    const bool ordered = plan.runs("sort") || (at_rest && list_.sorted);
    const std::string strategy = ordered ? sort_.strategy : "none";
    if (!list_is_valid(stats, strategy)) list_ = simulator_.prepare(view, {strategy, sort_.depth_bits});
    list_strategy_ = strategy;
    last_view_ = view;
    last_step_ = backend.step_number();
    drawn_.push_back(static_cast<float>(list_.count));
    culled_.push_back(static_cast<float>(list_.culled));

    {
        const StageTimer timer(log_, "draw calls");
        renderer_.draw(plan, view, list_, time_s);
    }
    for (const gl::PassTime& pass : renderer_.times()) log_.add("gl " + pass.name, pass.ms);
}

}  // namespace spindrift::app
