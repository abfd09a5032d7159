// SPDX-License-Identifier: MIT
#include "app/run_loop.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/frame_drawer.h"
#include "app/progress_bar.h"
#include "core/error.h"
#include "cpu/snapshot_file.h"
#include "scene/make_world.h"

namespace spindrift::app
{

std::unique_ptr<Simulator> start_simulator(RunState& run, Drawing drawing)
{
    const auto make = run.input.choice.name == "cuda" ? make_cuda_engine : make_cpu_engine;
    Engine engine = make(run.input.world, run.options, run.input.scene.reorder_every_steps, drawing);
    run.report.way = engine.way;
    run.report.buffer_bytes = engine.memory->bytes();
    auto simulator =
        std::make_unique<Simulator>(std::move(engine.memory), std::move(engine.backend), run.log);
    run.report.backend = simulator->backend().name();
    if (run.options.load_snapshot.empty()) return simulator;

    const std::filesystem::path& file = run.options.load_snapshot;
    const Snapshot snapshot = cpu::read_snapshot(file);
    try
    {
        simulator->backend().restore(snapshot);
    }
    catch (const Error& e)
    {
        throw Error(fmt::format("{}: {}", file.string(), e.what()));
    }
    return simulator;
}

FrameClock make_clock(const RunInput& input, std::uint64_t steps_done)
{
    const double done_s = static_cast<double>(steps_done) * input.world.step_s;
    const double start_s = steps_done > 0 ? done_s : input.scene.render.warm_up_s;
    return {start_s, input.scene.render.frames_per_s, input.world.step_s};
}

bool advance(RunState& run, Simulator& simulator, std::uint64_t steps)
{
    return simulator.advance_to(steps, [&] { return run.interrupt.requested(); });
}

void conclude(RunState& run, Simulator& simulator)
{
    Backend& backend = simulator.backend();
    run.report.counts = simulator.exact_counts();
    run.report.extent = backend.extent();
    run.report.steps = backend.step_number();
    run.report.state_hash = backend.state_hash();
    run.report.interrupted = run.interrupt.requested();
    if (!run.options.save_snapshot.empty()) cpu::write_snapshot(backend.save(), run.options.save_snapshot);
    run.report.stages = run.log.summaries();
}

void simulate_only(RunState& run)
{
    const auto simulator = start_simulator(run, Drawing::off);
    const std::uint64_t first = simulator->backend().step_number();
    const FrameClock clock = make_clock(run.input, first);
    const auto last_frame = static_cast<std::uint64_t>(run.input.scene.render.frames) - 1;
    const std::uint64_t end = run.options.steps ? first + *run.options.steps : clock.steps_before(last_frame);

    ProgressBar bar("steps", end - std::min(first, end));
    simulator->advance_to(
        end, [&] { return run.interrupt.requested(); },
        [&] { bar.show(simulator->backend().step_number() - first); });
    conclude(run, *simulator);
}

void warm_up(RunState& run, Simulator& simulator, std::uint64_t end)
{
    const std::uint64_t first = simulator.backend().step_number();
    if (first >= end) return;
    ProgressBar bar("warm-up steps", end - first);
    simulator.advance_to(
        end, [&] { return run.interrupt.requested(); },
        [&] { bar.show(simulator.backend().step_number() - first); });
}

namespace
{

void draw_frames(RunState& run, Simulator& simulator, FrameDrawer& drawer, const FrameClock& clock,
                 Outputs& outputs)
{
    const auto frames = static_cast<std::uint64_t>(run.input.scene.render.frames);
    ProgressBar bar("frames", frames);
    for (std::uint64_t k = 0; k < frames && !run.interrupt.requested(); ++k)
    {
        const StageTimer whole_frame(run.log, "frame");
        if (!advance(run, simulator, clock.steps_before(k))) return;
        const double time_s = clock.time_s(k);
        drawer.draw(scene::camera_at(run.input.scene, time_s), time_s);
        run.luminance.add(drawer.renderer(), k, time_s);
        outputs.add(drawer.renderer(), run.log);
        run.report.frames = k + 1;
        bar.show(k + 1);
    }
}

}  // namespace

void draw_headless(RunState& run, Outputs& outputs)
{
    const std::unique_ptr<gl::Context> context = make_drawing_context();
    run.report.gl = context->info();
    const auto simulator = start_simulator(run, Drawing::on);
    const FrameClock clock = make_clock(run.input, simulator->backend().step_number());
    FrameDrawer drawer(run.input.scene, run.input.geometry, run.input.world, *simulator, context->info(),
                       cpu_options(run.options), run.log);

    warm_up(run, *simulator, clock.steps_before(0));
    draw_frames(run, *simulator, drawer, clock, outputs);
    outputs.finish(drawer.renderer(), run.log);
    run.report.passes = drawer.plans().passes();
    run.report.flakes = {drawer.sort(), drawer.drawn(), drawer.culled()};
    run.report.gl_errors = gl::Context::debug_errors();
    conclude(run, *simulator);
}

}  // namespace spindrift::app
