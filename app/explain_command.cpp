// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/find_scene.h"
#include "app/run_report.h"
#include "core/flake.h"
#include "cpu/wind_projection.h"
#include "gl/frame_plan.h"
#include "scene/make_world.h"

namespace spindrift::app
{

namespace
{

using Json = nlohmann::ordered_json;

/// What memory a run will need, known before it starts.
struct MemoryNeed
{
    std::uint64_t flakes, voxels, wind, picture;
    std::uint64_t total() const { return flakes + voxels + wind + picture; }
};

struct Explained
{
    scene::Scene scene;
    World world;
    std::size_t triangles = 0, lights = 0;
    gl::FramePlan plan;
    MemoryNeed memory{};
};

MemoryNeed memory_need(const scene::Scene& scene, const World& world)
{
    // RGBA16F target, 32-bit depth and its copy, 8-bit display picture
    constexpr std::uint64_t kBytesPerPixel = 8 + 4 + 4 + 4;
    const auto pixels = static_cast<std::uint64_t>(scene.render.width_px) *
                        static_cast<std::uint64_t>(scene.render.height_px);
    return {world.capacity * (kStateBytesPerFlake + kDrawListBytesPerFlake),
            world.voxels.clearance.size() + world.voxels.surface.size(),
            world.wind.cells.size() * sizeof(WindCell), pixels * kBytesPerPixel};
}

Explained explain_scene(const ExplainOptions& options)
{
    Explained e;
    e.scene = scene::read_scene(find_scene(options.scene), options.overrides);
    const scene::Geometry geometry = scene::read_geometry(e.scene);
    for (const scene::Mesh& mesh : geometry.meshes)
        for (const scene::MeshPart& part : mesh.parts) e.triangles += part.indices.size() / 3;
    e.world = scene::make_world(e.scene, geometry, cpu::project_wind());
    e.lights = e.scene.lights.size() + geometry.model_lights.size();

    gl::FrameStats stats;
    stats.counts.alive = stats.counts.emitted = stats.drawn = e.world.capacity;
    const double time_s = e.scene.render.warm_up_s;
    stats.brightest_emission = scene::brightest_emission(geometry);
    e.plan = gl::plan_frame(e.scene, scene::camera_at(e.scene, time_s), stats, time_s, geometry.model_lights);
    e.memory = memory_need(e.scene, e.world);
    return e;
}

const char* name(WindKind kind)
{
    switch (kind)
    {
        case WindKind::uniform:
            return "uniform";
        case WindKind::logarithmic:
            return "logarithmic profile";
        case WindKind::grid:
            return "grid";
    }
    return "?";
}

double megabytes(std::uint64_t bytes)
{
    return static_cast<double>(bytes) / 1e6;
}

void print_scene(const Explained& e)
{
    const World& w = e.world;
    fmt::print("{} ({})\n", e.scene.name, e.scene.file.string());
    if (!e.scene.about.empty()) fmt::print("{}\n", e.scene.about);
    fmt::print("\nScene\n");
    fmt::print("  domain      {:g} x {:g} x {:g} m, steps of {:g} s, seed {}\n", w.size_m.x, w.size_m.y,
               w.size_m.z, w.step_s, w.seed);
    fmt::print("  flakes      room for {}, {} emitter(s); each stands for {:g}; {:g} mm/h\n", w.capacity,
               w.emitters.size(), w.snow.weight, w.snow.rate_mm_h);
    for (const Emitter& emitter : w.emitters)
        if (emitter.shape == EmitterShape::drift)
            fmt::print("  drift       {}\n", emitter.rate_per_s > 0
                                                 ? fmt::format("{:.0f} drawn flakes/s, out of {:.3f} m",
                                                               emitter.rate_per_s, emitter.radius_m)
                                                 : "none: the wind is below the threshold");
    fmt::print("  wind        {}{}\n", name(w.wind.kind),
               w.wind.turbulent ? ", turbulent" : ", no turbulence");
    if (!w.wind.cells.empty())
        fmt::print("              {} x {} x {} cells\n", w.wind.nx, w.wind.ny, w.wind.nz);
    if (w.voxels.nx > 0)
        fmt::print("  solids      {} x {} x {} voxels of {:g} m\n", w.voxels.nx, w.voxels.ny, w.voxels.nz,
                   w.voxels.cell_m);
    fmt::print("  drawn       {} triangles, {} light(s)\n", e.triangles, e.lights);
    fmt::print("  picture     {} x {} px, {} frames at {:g} per s after {:g} s of warm-up\n",
               e.scene.render.width_px, e.scene.render.height_px, e.scene.render.frames,
               e.scene.render.frames_per_s, e.scene.render.warm_up_s);
}

void print_text(const Explained& e)
{
    print_scene(e);
    fmt::print("\nSimulation leaves out\n");
    for (const Skip& skip : simulation_skips(e.world, e.scene.reorder_every_steps))
        fmt::print("  {}: {}\n", skip.what, skip.why);
    fmt::print("\nFirst frame\n{}", gl::to_text(e.plan));
    fmt::print("\nMemory, estimated: {:.1f} MB\n", megabytes(e.memory.total()));
    fmt::print("  flakes {:.1f}, voxels {:.1f}, wind {:.1f}, picture {:.1f}\n", megabytes(e.memory.flakes),
               megabytes(e.memory.voxels), megabytes(e.memory.wind), megabytes(e.memory.picture));
}

void print_json(const Explained& e)
{
    Json passes = Json::array();
    for (const gl::PlannedPass& p : e.plan.passes)
        passes.push_back({{"pass", p.name},
                          {"runs", p.runs},
                          {"why", p.reason},
                          {"reads", p.reads},
                          {"writes", p.writes},
                          {"megabytes", p.cost.megabytes},
                          {"million_elements", p.cost.million_elements}});
    Json skips = Json::array();
    for (const Skip& skip : simulation_skips(e.world, e.scene.reorder_every_steps))
        skips.push_back({{"what", skip.what}, {"why", skip.why}});
    const World& w = e.world;
    const Json json = {{"scene",
                        {{"name", e.scene.name},
                         {"file", e.scene.file.string()},
                         {"about", e.scene.about},
                         {"seed", w.seed}}},
                       {"domain_m", {w.size_m.x, w.size_m.y, w.size_m.z}},
                       {"step_s", w.step_s},
                       {"capacity", w.capacity},
                       {"emitters", w.emitters.size()},
                       {"wind",
                        {{"kind", name(w.wind.kind)},
                         {"turbulent", w.wind.turbulent},
                         {"cells", {w.wind.nx, w.wind.ny, w.wind.nz}}}},
                       {"voxels", {w.voxels.nx, w.voxels.ny, w.voxels.nz}},
                       {"triangles", e.triangles},
                       {"lights", e.lights},
                       {"frame", passes},
                       {"skipped", skips},
                       {"memory_bytes",
                        {{"flakes", e.memory.flakes},
                         {"voxels", e.memory.voxels},
                         {"wind", e.memory.wind},
                         {"picture", e.memory.picture}}}};
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

int explain(const ExplainOptions& options)
{
    const Explained explained = explain_scene(options);
    options.json ? print_json(explained) : print_text(explained);
    return kOk;
}

}  // namespace spindrift::app
