// SPDX-License-Identifier: MIT
#include "spindrift/simulation.h"

#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "app/frame_drawer.h"
#include "app/machine.h"
#include "app/simulator.h"
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

}  // namespace

struct Simulation::Impl
{
    scene::Scene scene;
    scene::Geometry geometry;
    World world;
    app::StageLog log{app::StageLog::Keep::newest};
    std::unique_ptr<gl::Context> context;  // outlives all that holds GL objects
    std::unique_ptr<app::Simulator> simulator;
    std::unique_ptr<app::FrameDrawer> drawer;
    FlakeView flakes{};
    bool drawn = false;

    Impl(const std::filesystem::path& file, const SimulationOptions& options)
        : scene(scene::read_scene(file, overrides(options))),
          geometry(scene::read_geometry(scene)),
          world(scene::make_world(scene, geometry, cpu::project_wind()))
    {
        const bool pictures = options.pictures == Pictures::on;
        if (pictures) context = gl::make_headless_context();
        auto memory =
            pictures ? app::make_shared_memory(world.capacity) : app::make_host_memory(world.capacity);
        flakes = memory->flakes();
        const cpu::CpuOptions cpu{options.threads, app::parse_simd(options.simd), scene.reorder_every_steps};
        auto backend = cpu::make_cpu_backend(world, flakes, memory->draw_list(), cpu);
        simulator = std::make_unique<app::Simulator>(std::move(memory), std::move(backend), log);
        if (pictures)
            drawer = std::make_unique<app::FrameDrawer>(scene, geometry, world, *simulator, context->info(),
                                                        cpu, log);
    }

    Backend& backend() const { return simulator->backend(); }
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
    return impl_->backend().counts();
}
std::uint64_t Simulation::state_hash() const
{
    return impl_->backend().state_hash();
}
FlakeView Simulation::flakes() const
{
    return impl_->flakes;
}
std::size_t Simulation::slots_used() const
{
    return impl_->backend().slots_used();
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
