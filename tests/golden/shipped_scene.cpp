// SPDX-License-Identifier: MIT
#include "tests/golden/shipped_scene.h"

#include <cmath>

#include "cpu/cpu_backend.h"
#include "cpu/tile_splatter.h"
#include "cpu/wind_projection.h"
#include "gl/context.h"
#include "gl/frame_plan.h"
#include "gl/renderer.h"
#include "reference/development.h"
#include "reference/reference.h"

namespace spindrift::golden
{

Shown show(const Showing& showing)
{
    scene::SceneOverrides overrides;
    overrides.particles = showing.particles;
    overrides.width_px = showing.width_px;
    overrides.height_px = showing.height_px;
    scene::Scene scene =
        scene::read_scene(SPINDRIFT_SOURCE_DIR "/scenes/" + showing.name + ".toml", overrides);
    scene.render.flake_path = showing.path;
    scene.display.dither = false;
    const scene::Geometry geometry = scene::read_geometry(scene);
    const World world = scene::make_world(scene, geometry, cpu::project_wind());
    const gl::FlakeBuffers buffers(world.capacity);
    const auto backend = cpu::make_cpu_backend(world, buffers.flakes(), buffers.draw_list(), {});
    const auto steps = static_cast<int>(std::lround(showing.time_s / world.step_s));
    for (int i = 0; i < steps; ++i) backend->step();

    const View view = scene::camera_at(scene, showing.time_s);
    const DrawList list =
        backend->prepare(view, {});  // always sorted: the picture does not depend on what the scene asks for
    gl::FrameStats stats;
    stats.counts = backend->counts();
    const auto splatter = cpu::make_tile_splatter({});
    gl::Renderer renderer(scene, geometry, world, buffers, view.width_px, view.height_px, splatter.get());
    renderer.draw(gl::plan_frame(scene, view, stats, showing.time_s, geometry.model_lights), view, list,
                  showing.time_s);
    Shown shown{renderer.read_linear(),
                renderer.read_display(),
                reference::render(scene, geometry, world, buffers.flakes(), backend->slots_used(), view,
                                  showing.time_s),
                {},
                list.count,
                gl::Context::debug_errors()};
    shown.developed = reference::develop(shown.reference, scene);
    return shown;
}

}  // namespace spindrift::golden
