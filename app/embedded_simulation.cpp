// SPDX-License-Identifier: MIT
#include "spindrift/simulation.h"

#include <cmath>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "app/backend_choice.h"
#include "app/engine.h"
#include "app/frame_drawer.h"
#include "app/machine.h"
#include "app/options.h"
#include "app/simulator.h"
#include "app/sort_choice.h"
#include "cpu/snapshot_file.h"
#include "cpu/wind_projection.h"
#include "gl/context.h"
#include "image/write.h"
#include "scene/make_world.h"

namespace spindrift
{

namespace
{

scene::SceneOverrides overrides(const SimulationOptions& options)
{
    scene::SceneOverrides result;
    result.particles = options.particles;
    result.seed = options.seed;
    result.width_px = options.width_px;
    result.height_px = options.height_px;
    return result;
}

bool never()
{
    return false;
}

/// As the command would be asked for it.
app::RunOptions run_options(const SimulationOptions& options)
{
    app::RunOptions run;
    run.backend = options.backend;
    if (options.threads != 0) run.threads = options.threads;
    if (options.simd != "auto") run.simd = app::parse_simd(options.simd);
    return run;
}

app::BackendChoice choose(const SimulationOptions& options)
{
    return app::choose_backend({.backend = options.backend,
                                .cpu_option = options.threads != 0     ? "threads"
                                              : options.simd != "auto" ? "simd"
                                                                       : "",
                                .key = "backend ="},
                               app::cuda_support());
}

scene::Scene read(const std::filesystem::path& file, const SimulationOptions& options,
                  const std::string& backend)
{
    scene::Scene scene = scene::read_scene(file, overrides(options));
    scene.render.sort = app::choose_sort(backend, scene.render.sort);
    return scene;
}

}  // namespace

struct Simulation::Impl
{
    app::BackendChoice choice;
    scene::Scene scene;
    scene::Geometry geometry;
    World world;
    app::StageLog log{app::StageLog::Keep::newest};
    std::unique_ptr<gl::Context> context;  // outlives all that holds GL objects
    std::unique_ptr<app::Simulator> simulator;
    std::unique_ptr<app::FrameDrawer> drawer;
    FlakeView live{};                              ///< null where the flakes lie on a device
    std::vector<std::vector<std::uint32_t>> copy;  ///< of flakes on a device
    bool drawn = false;

    Impl(const std::filesystem::path& file, const SimulationOptions& options)
        : choice(choose(options)),
          scene(read(file, options, choice.name)),
          geometry(scene::read_geometry(scene)),
          world(scene::make_world(
              scene, geometry,
              cpu::project_wind(on_device() ? app::cuda_poisson_solver() : PoissonSolverMaker{})))
    {
        const bool pictures = options.pictures == Pictures::on;
        if (pictures) context = on_device() ? app::make_drawing_context() : gl::make_headless_context();
        const app::RunOptions run = run_options(options);
        const auto make = on_device() ? app::make_cuda_engine : app::make_cpu_engine;
        app::Engine engine =
            make(world, run, scene.reorder_every_steps, pictures ? app::Drawing::on : app::Drawing::off);
        if (const auto* host = dynamic_cast<const app::HostFlakeMemory*>(engine.memory.get()))
            live = host->flakes();
        simulator =
            std::make_unique<app::Simulator>(std::move(engine.memory), std::move(engine.backend), log);
        if (pictures)
            drawer = std::make_unique<app::FrameDrawer>(scene, geometry, world, *simulator, context->info(),
                                                        app::cpu_options(run), log);
    }

    bool on_device() const { return choice.name == "cuda"; }
    Backend& backend() const { return simulator->backend(); }

    FlakeView flakes()
    {
        if (!on_device()) return live;
        copy = backend().save().arrays;
        const auto floats = [&](std::size_t array) { return reinterpret_cast<float*>(copy[array].data()); };
        return {floats(0), floats(1), floats(2), floats(3),      floats(4),      floats(5),
                floats(6), floats(7), floats(8), copy[9].data(), copy[10].data()};
    }
};

Simulation::Simulation(const std::filesystem::path& scene, const SimulationOptions& options)
    : impl_(std::make_unique<Impl>(scene, options))
{
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::step()
{
    impl_->backend().step();
}

void Simulation::advance_to(double time_s)
{
    if (!std::isfinite(time_s) || time_s < 0)
        throw Error(fmt::format("{} s is no time to advance to; use 0 or more", time_s));
    // Forgives rounding of k / fps against n * step, as the command does.
    impl_->simulator->advance_to(static_cast<std::uint64_t>(std::floor(time_s / step_s() + 1e-6)), never);
}

std::string Simulation::backend() const
{
    return impl_->backend().name();
}
double Simulation::step_s() const
{
    return impl_->world.step_s;
}
double Simulation::time_s() const
{
    return static_cast<double>(steps()) * step_s();
}
std::uint64_t Simulation::steps() const
{
    return impl_->backend().step_number();
}
FlakeCounts Simulation::counts() const
{
    return impl_->simulator->exact_counts();
}
std::uint64_t Simulation::state_hash() const
{
    return impl_->backend().state_hash();
}
FlakeView Simulation::flakes() const
{
    return impl_->flakes();
}
std::size_t Simulation::slots_used() const
{
    return impl_->on_device() ? counts().alive : impl_->backend().slots_used();
}

void Simulation::save(const std::filesystem::path& snapshot) const
{
    cpu::write_snapshot(impl_->backend().save(), snapshot);
}

void Simulation::load(const std::filesystem::path& snapshot)
{
    impl_->backend().restore(cpu::read_snapshot(snapshot));
}

void Simulation::draw()
{
    if (!impl_->drawer) throw Error("draw() needs a simulation that was made with Pictures::on");
    impl_->drawer->draw(scene::camera_at(impl_->scene, time_s()), time_s());
    impl_->drawn = true;
}

void Simulation::write_picture(const std::filesystem::path& file) const
{
    if (!impl_->drawn)
        throw Error(fmt::format("{}: nothing has been drawn yet; call draw() first", file.string()));
    const gl::Renderer& renderer = impl_->drawer->renderer();
    if (file.extension() == ".exr") return image::write_exr(file, renderer.read_linear());
    if (file.extension() == ".png") return image::write_png(file, renderer.read_display());
    throw Error(fmt::format("{}: is no kind of picture that can be written; end the name in .png or .exr",
                            file.string()));
}

}  // namespace spindrift
