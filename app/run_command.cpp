// SPDX-License-Identifier: MIT
#include <chrono>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/find_scene.h"
#include "app/machine.h"
#include "app/run_loop.h"
#include "app/sort_choice.h"
#include "app/window_loop.h"
#include "core/error.h"
#include "cpu/wind_projection.h"
#include "image/whole_file.h"
#include "scene/make_world.h"

namespace spindrift::app
{

namespace
{

void check_combinations(const RunOptions& options)
{
    if (options.steps && !options.out.empty())
        throw Error("--steps draws nothing, so --out would stay empty; use --frames with --out");
    if (options.steps && !options.headless) throw Error("--steps draws nothing; add --headless");
    if (!options.out.empty() && !options.headless)
        throw Error("--out writes pictures without a window; add --headless");
    if (options.beside_ldr && options.out.empty())
        throw Error("--beside-ldr changes the pictures of --out, and there are none; add --out");
    if (options.luminance.empty() != options.pixels.empty())
        throw Error("--luminance and --pixel go together; give both");
    if (!options.luminance.empty() && options.out.empty())
        throw Error("--luminance reads pictures, and none is drawn; add --out");
    if (options.interop == Interop::on && options.headless && options.out.empty())
        throw Error(
            "--interop on: nothing is drawn without --out, so there is no GL memory to share; add --out");
}

/// A run must not find out at its end that its files cannot be written.
void check_files(const RunOptions& options)
{
    for (const auto& file : {options.stats, options.save_snapshot, options.luminance})
        if (!file.empty()) const image::AsideFile probe(file);
}

RunInput read_input(const RunOptions& options)
{
    const BackendChoice choice = choose_backend(wish_of(options), cuda_support());
    scene::Scene scene = scene::read_scene(find_scene(options.scene), options.overrides);
    if (options.depth_bits) scene.render.depth_bits = *options.depth_bits;
    scene.render.sort = choose_sort(choice.name, scene.render.sort);
    scene::Geometry geometry = scene::read_geometry(scene);
    World world = scene::make_world(
        scene, geometry,
        cpu::project_wind(choice.name == "cuda" ? cuda_poisson_solver() : PoissonSolverMaker{}));
    return {std::move(scene), std::move(geometry), std::move(world), choice};
}

void describe_machine(RunState& run)
{
    run.report.choice = run.input.choice;
    run.report.threads = usable_threads(cpu_options(run.options));
    run.report.simd = used_simd(cpu_options(run.options));
    run.report.skips = simulation_skips(run.input.world, run.input.scene.reorder_every_steps);
}

void print_summary(const RunState& run)
{
    const RunReport& r = run.report;
    fmt::print("{}: {} steps, {} frames in {:.1f} s; {} flakes alive of {} emitted{}\n", run.input.scene.name,
               r.steps, r.frames, r.wall_s, r.counts.alive, r.counts.emitted,
               r.interrupted ? " (interrupted)" : "");
    for (const std::string& file : r.outputs) fmt::print("wrote {}\n", file);
    if (!run.options.luminance.empty()) fmt::print("wrote {}\n", run.options.luminance.string());
    if (!run.options.stats.empty()) fmt::print("wrote {}\n", run.options.stats.string());
    if (!run.options.save_snapshot.empty()) fmt::print("wrote {}\n", run.options.save_snapshot.string());
    if (run.options.hash) fmt::print("hash {}\n", hash_text(r.state_hash));
}

void run_loop(RunState& run)
{
    if (!run.options.headless) return draw_in_window(run);
    if (run.options.out.empty())
    {
        run.report.no_gl_because = "nothing is drawn: --headless without --out";
        return simulate_only(run);
    }
    Outputs outputs(run.options.out, run.input.scene.render,
                    run.options.beside_ldr ? Beside::low_range : Beside::nothing);
    draw_headless(run, outputs);
    if (run.report.frames > 0) run.report.outputs = run.options.out;
}

}  // namespace

int run(const RunOptions& options)
{
    check_combinations(options);
    check_files(options);
    if (!options.headless) require_display();
    const auto start = std::chrono::steady_clock::now();
    const RunInput input = read_input(options);
    RunState run{options, input, {}, {}, LuminanceLog(input.scene, options.pixels), {}};
    describe_machine(run);
    run_loop(run);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    run.report.wall_s = wall.count();

    if (!options.luminance.empty()) image::write_whole(options.luminance, run.luminance.csv());
    if (!options.stats.empty()) write_report(options.stats, run.report, input.scene, input.world);
    print_summary(run);
    if (!run.report.gl_errors.empty()) throw std::runtime_error("GL reported: " + run.report.gl_errors);
    if (const std::int64_t difference = imbalance(run.report.counts); difference != 0)
        throw std::runtime_error(fmt::format("{} flakes were lost or made twice", difference));
    return run.report.interrupted ? kInterrupted : kOk;
}

}  // namespace spindrift::app
