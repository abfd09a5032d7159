// SPDX-License-Identifier: MIT
#include "app/command_line.h"

#include <cmath>
#include <cstdio>
#include <map>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/build_info.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/machine.h"
#include "core/error.h"
#include "cpu/sort/strategy.h"

namespace spindrift::app
{

namespace
{

constexpr const char* kAbout =
    "Simulates and draws blowing snow.\n"
    "Exit codes: 0 done, 1 internal error, 2 bad input, 130 interrupted (files are whole).";

constexpr const char* kExamples = R"(
Examples:
  spindrift run town                                         in a window
  spindrift run town --headless --out town.mp4 --out town.png
  spindrift run my.toml --headless --out 'f_%04d.exr' --size 1920x1080 --frames 240
  spindrift run two-blocks --wind F_windsWk.nc --turbulence F_turbOut.nc
  spindrift explain town                                     what a frame does and why
)";

constexpr const char* kRunExamples = R"(
Examples:
  spindrift run town --headless --out town.mp4 --out town.png --stats town.json
  spindrift run canyon --headless --steps 600 --hash --threads 2 --simd scalar
  spindrift run sheet --headless --steps 300 --save-snapshot s.snap
  spindrift run sheet --headless --load-snapshot s.snap --out later.png --frames 1

In the window: W A S D Q E move, Shift is fast, right drag looks, left drag orbits, the wheel sets speed or distance,
C is the scene's camera, Space pauses, N steps, T takes the next sort, F1 hides the overlay, Esc quits.
)";

/// "1280x720"
struct Size
{
    int width_px = 0, height_px = 0;
};

Size parse_size(const std::string& text)
{
    constexpr int kMost = 16384;
    int end = 0;
    Size size;
    const int fields = std::sscanf(text.c_str(), "%5dx%5d%n", &size.width_px, &size.height_px, &end);
    const bool whole = fields == 2 && end == static_cast<int>(text.size());
    if (!whole || size.width_px < 1 || size.height_px < 1 || size.width_px > kMost || size.height_px > kMost)
        throw CLI::ValidationError(
            "--size", fmt::format("{} is no size; use WIDTHxHEIGHT in pixels, each 1 to {}, such as 1280x720",
                                  text, kMost));
    return size;
}

void check_rate(double frames_per_s)
{
    if (!std::isfinite(frames_per_s) || frames_per_s <= 0 || frames_per_s > 10000)
        throw CLI::ValidationError(
            "--fps", fmt::format("{} is no frame rate; use more than 0, at most 10000", frames_per_s));
}

std::string sort_help()
{
    std::string text = "How flakes are put in order, far to near:";
    for (const cpu::SortStrategy& strategy : cpu::sort_strategies())
        text += fmt::format("\n  {}: {}", strategy.name, strategy.about);
    return text;
}

/// Options that change the scene, which run and explain share.
void add_scene_options(CLI::App& command, scene::SceneOverrides& scene)
{
    const char* group = "The scene, changed";
    command
        .add_option("--particles", scene.particles,
                    "Room for this many flakes; bursts and rates are scaled with it")
        ->type_name("N")
        ->check(CLI::PositiveNumber)
        ->group(group);
    command.add_option("--seed", scene.seed, "Seed of every random number")->type_name("X")->group(group);
    command.add_option("--wind", scene.winds_file, "Wind field: a QES-Winds file *_windsWk.nc")
        ->type_name("FILE")
        ->group(group);
    command.add_option("--turbulence", scene.turbulence_file, "Its turbulence: *_turbOut.nc")
        ->type_name("FILE")
        ->group(group);
    command
        .add_option_function<std::string>(
            "--size",
            [&scene](const std::string& text)
            {
                const Size size = parse_size(text);
                scene.width_px = size.width_px;
                scene.height_px = size.height_px;
            },
            "Size of the picture in pixels")
        ->type_name("WxH")
        ->group(group);
    command.add_option("--frames", scene.frames, "Frames to draw")
        ->type_name("N")
        ->check(CLI::Range(1, 10000000))
        ->group(group);
    command
        .add_option_function<double>(
            "--fps",
            [&scene](double rate)
            {
                check_rate(rate);
                scene.frames_per_s = rate;
            },
            "Frames per second of simulated time")
        ->type_name("F")
        ->group(group);
    command.add_option("--sort", scene.sort, sort_help())->type_name("S")->group(group);
    command
        .add_option(
            "--flake-path", scene.flake_path,
            "How blended flakes are drawn: raster, tiles (by the processor), or auto: tiles on software GL")
        ->type_name("P")
        ->check(CLI::IsMember({"auto", "raster", "tiles"}))
        ->group(group);
}

void add_run(CLI::App& app, RunOptions& options)
{
    CLI::App& command = *app.add_subcommand("run", "Simulate a scene and draw it");
    command.footer(kRunExamples);
    command.add_option("scene", options.scene, "A TOML file, or the name of a shipped scene")
        ->required()
        ->type_name("SCENE");
    add_scene_options(command, options.overrides);
    command.add_option("--depth-bits", options.depth_bits, "Bits of the depth key that are sorted by")
        ->type_name("B")
        ->check(CLI::IsMember({32, 24, 16}))
        ->group("The scene, changed");

    const char* output = "Output";
    command
        .add_flag("--headless", options.headless, "No window. Without --out nothing is drawn, only simulated")
        ->group(output);
    command
        .add_option("--out", options.out,
                    "Where the pictures go: x.mp4, x_%04d.png or .exr (every frame), x.png or .exr (the "
                    "last). May be repeated")
        ->type_name("PATTERN")
        ->allow_extra_args(false)
        ->group(output);
    command.add_option("--stats", options.stats, "Counts, hash, times and what was skipped, as JSON")
        ->type_name("FILE")
        ->group(output);
    command
        .add_flag("--hash", options.hash,
                  "Print the hash of the final state; it is the same on every machine")
        ->group(output);
    command
        .add_option("--steps", options.steps, "Simulate exactly N steps and draw nothing (with --headless)")
        ->type_name("N")
        ->group(output);
    command.add_option("--save-snapshot", options.save_snapshot, "Save the final state")
        ->type_name("FILE")
        ->group(output);
    command
        .add_option("--load-snapshot", options.load_snapshot, "Go on from a saved state of the same scene")
        ->type_name("FILE")
        ->group(output);

    const char* machine = "The machine";
    command.add_option("--backend", options.backend, "auto, cpu or cuda")
        ->type_name("B")
        ->check(CLI::IsMember({"auto", "cpu", "cuda"}))
        ->capture_default_str()
        ->group(machine);
    command.add_option("--threads", options.cpu.threads, "Threads of the simulation; 0: one per core")
        ->type_name("T")
        ->check(CLI::Range(0, 1024))
        ->group(machine);
    command
        .add_option_function<std::string>(
            "--simd", [&options](const std::string& word) { options.cpu.simd = parse_simd(word); },
            "Vector width: auto, scalar, avx2 or avx512; the result is the same")
        ->type_name("S")
        ->check(CLI::IsMember({"auto", "scalar", "avx2", "avx512"}))
        ->group(machine);
    static const std::map<std::string, Interop> kInterop = {
        {"auto", Interop::automatic}, {"on", Interop::on}, {"off", Interop::off}};
    command
        .add_option("--interop", options.interop,
                    "Simulate in the memory that GL draws from: auto, on, or off (copy each frame)")
        ->type_name("I")
        ->transform(CLI::Transformer(kInterop).description(""))
        ->group(machine);
}

void add_explain(CLI::App& app, ExplainOptions& options)
{
    CLI::App& command =
        *app.add_subcommand("explain", "Say what a frame of a scene does, leaves out, and why");
    command.add_option("scene", options.scene, "A TOML file, or the name of a shipped scene")
        ->required()
        ->type_name("SCENE");
    add_scene_options(command, options.overrides);
    command.add_flag("--json", options.json, "As JSON");
}

void add_calibrate(CLI::App& app, CalibrateOptions& options)
{
    CLI::App& command = *app.add_subcommand(
        "calibrate", "Repeat the report's experiment: grey of a black rectangle by particles per second");
    command.add_option("scene", options.scene, "A scene like sheet")
        ->type_name("SCENE")
        ->capture_default_str();
    command.add_option("--csv", options.csv, "The table, as CSV")->type_name("FILE");
    command.add_option("--plot", options.plot, "Readings, fit and the report's table, as SVG")
        ->type_name("FILE");
    command.add_option("--frames", options.frames, "Frames that are averaged at each rate")
        ->type_name("N")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    command.add_option("--most", options.most_per_s, "Leave out higher rates")
        ->type_name("PER_S")
        ->check(CLI::Range(100.0, 1e6))
        ->capture_default_str();
    command.add_option("--seed", options.overrides.seed, "Seed of every random number")->type_name("X");
}

}  // namespace

int run_command_line(int argc, char** argv)
{
    CLI::App app(kAbout, "spindrift");
    app.set_version_flag("--version", fmt::format("spindrift {}", kVersion));
    app.set_help_all_flag("--help-all", "Help of every subcommand");
    app.require_subcommand(1);
    app.footer(kExamples);
    app.get_formatter()->column_width(34);

    RunOptions run_options;
    ExplainOptions explain_options;
    CalibrateOptions calibrate_options;
    add_run(app, run_options);
    add_explain(app, explain_options);
    add_calibrate(app, calibrate_options);
    app.add_subcommand("info", "Backend, processor, GL renderer and libraries of this build and machine");
    app.add_subcommand("scenes", "List the shipped scenes");
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::ParseError& e)
    {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
        throw Error(fmt::format("{}; see spindrift --help", e.what()));
    }
    if (app.got_subcommand("run")) return run(run_options);
    if (app.got_subcommand("explain")) return explain(explain_options);
    if (app.got_subcommand("calibrate")) return calibrate(calibrate_options);
    if (app.got_subcommand("info")) return info();
    return list_scenes();
}

}  // namespace spindrift::app
