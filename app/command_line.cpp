// SPDX-License-Identifier: MIT
#include "app/command_line.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/build_info.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/machine.h"
#include "app/sort_choice.h"
#include "core/error.h"
#include "measure/sort_keys.h"

namespace spindrift::app
{

namespace
{

constexpr const char* kAbout =
    "Simulates and draws blowing snow.\n"
    "Exit codes: 0 done, 1 internal error or failed check, 2 bad input, 130 interrupted (files are whole).";

constexpr const char* kExamples = R"(
Examples:
  spindrift run town                                         in a window
  spindrift run town --headless --out town.mp4 --out town.png
  spindrift run my.toml --headless --out 'f_%04d.exr' --size 1920x1080 --frames 240
  spindrift run two-blocks --wind F_windsWk.nc --turbulence F_turbOut.nc
  spindrift wind town -o wind.nc                             solve for its wind, for ParaView, xarray and QES-Plume
  spindrift explain town                                     what a frame does and why
  spindrift validate --case gaussian-plume,taylor            measured beside what is known
  spindrift sorts --scene town                               which sort suits this machine and scene
  spindrift run plow --headless --beside-ldr --out plow.png  low beside high dynamic range
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

constexpr const char* kSortsExamples = R"(
Examples:
  spindrift sorts                                      made-up keys, 65K and 1M pairs
  spindrift sorts --scene town --out town.csv          a camera path, with the error of the picture
  spindrift sorts --sizes 1M --patterns camera-sweep --strategies radix,bitonic-passes --sort-passes 16
  spindrift sorts --table-4-1                          beside the report's figures

x floor: time over that of copying the bytes that a radix sort of the same key bits must move (8 + 16 a digit).
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

/// "640,360"
std::array<int, 2> parse_pixel(const std::string& text)
{
    int end = 0;
    std::array<int, 2> pixel{};
    const int fields = std::sscanf(text.c_str(), "%6d,%6d%n", &pixel[0], &pixel[1], &end);
    if (fields != 2 || end != static_cast<int>(text.size()) || pixel[0] < 0 || pixel[1] < 0)
        throw CLI::ValidationError(
            "--pixel",
            fmt::format("{} is no pixel; use COLUMN,ROW from the upper left, such as 640,360", text));
    return pixel;
}

void check_rate(double frames_per_s)
{
    if (!std::isfinite(frames_per_s) || frames_per_s <= 0 || frames_per_s > 10000)
        throw CLI::ValidationError(
            "--fps", fmt::format("{} is no frame rate; use more than 0, at most 10000", frames_per_s));
}

std::string sort_help()
{
    std::string text =
        "How flakes are put in order, far to near; auto is the exact sort that suits most, passes is short "
        "for "
        "bitonic-passes:";
    for (const char* backend : {"cpu", "cuda"})
        for (const SortName& sort : sorts_of(backend))
            text += fmt::format("\n  {} ({}): {}", sort.name, backend, sort.about);
    return text;
}

std::size_t parse_pairs(const std::string& text)
{
    constexpr std::uint64_t kMost = 100'000'000;
    std::uint64_t count = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, count);
    const std::string_view unit(rest, static_cast<std::size_t>(end - rest));
    const std::uint64_t factor = unit == "M" ? 1'000'000 : unit == "K" ? 1000 : 1;
    const bool whole = error == std::errc() && (unit.empty() || factor > 1);
    if (!whole || count == 0 || count > kMost / factor)
        throw CLI::ValidationError(
            "--sizes", fmt::format("{} is no number of pairs; use 1 to 100M, such as 15K,1M", text));
    return count * factor;
}

measure::KeyPattern parse_pattern(const std::string& text)
{
    std::string names;
    for (const measure::KeyPattern pattern : measure::kKeyPatterns)
    {
        if (measure::pattern_name(pattern) == text) return pattern;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", measure::pattern_name(pattern));
    }
    throw CLI::ValidationError("--patterns",
                               fmt::format("{} is no pattern of keys; use some of {}", text, names));
}

void add_sort_passes(CLI::App& command, scene::SceneOverrides& scene, const char* group)
{
    command
        .add_option("--sort-passes", scene.sort_passes_per_frame,
                    "Steps of the network a frame, of bitonic-passes and odd-even-passes")
        ->type_name("K")
        ->check(CLI::Range(1, 4096))
        ->group(group);
}

void add_wind_files(CLI::App& command, scene::SceneOverrides& scene)
{
    const char* group = "The scene, changed";
    command
        .add_option(
            "--wind", scene.winds_file,
            "Wind field: a file of QES-Winds (*_windsWk.nc), of spindrift wind, or QUIC's QU_velocity.dat")
        ->type_name("FILE")
        ->group(group);
    command
        .add_option("--turbulence", scene.turbulence_file,
                    "Its turbulence: *_turbOut.nc, or that of spindrift wind")
        ->type_name("FILE")
        ->group(group);
}

/// Options that change the scene, which run, explain and sorts share.
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
    add_wind_files(command, scene);
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
    command
        .add_option("--reorder", scene.reorder_every_steps,
                    "Put flakes in the order of the wind cells that they read after every N steps; 0: never. "
                    "The result is the same")
        ->type_name("N")
        ->check(CLI::Range(0, 1000000))
        ->group(group);
    add_sort_passes(command, scene, group);
    command
        .add_option("--shutter", scene.shutter_s,
                    "Seconds for which flakes are seen while they fly, as streaks; 0: at an instant")
        ->type_name("S")
        ->group(group);
    command
        .add_option("--blending", scene.blending,
                    "How flakes cover each other: over (sorted), additive, weighted, stochastic or opaque")
        ->type_name("B")
        ->check(CLI::IsMember({"over", "additive", "weighted", "stochastic", "opaque"}))
        ->group(group);
    command
        .add_option(
            "--flake-path", scene.flake_path,
            "How blended flakes are drawn: raster, tiles (by the processor), or auto: tiles on software GL")
        ->type_name("P")
        ->check(CLI::IsMember({"auto", "raster", "tiles"}))
        ->group(group);
}

void add_sort(CLI::App& command, scene::SceneOverrides& scene)
{
    command.add_option("--sort", scene.sort, sort_help())->type_name("S")->group("The scene, changed");
}

void add_backend(CLI::App& command, std::string& backend, const char* group)
{
    command.add_option("--backend", backend, "auto (cuda where there is a device, else cpu), cpu or cuda")
        ->type_name("B")
        ->check(CLI::IsMember({"auto", "cpu", "cuda"}))
        ->capture_default_str()
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
    add_sort(command, options.overrides);
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
    command
        .add_flag("--beside-ldr", options.beside_ldr,
                  "Pictures twice as wide: on the left what 8 bits would hold, without bloom or curve")
        ->group(output);
    command
        .add_option("--luminance", options.luminance,
                    "Luminance of the pixels of --pixel in cd/m2, frame by frame, as CSV; the scene's "
                    "[display] must be calibrated")
        ->type_name("FILE")
        ->group(output);
    command
        .add_option_function<std::vector<std::string>>(
            "--pixel",
            [&options](const std::vector<std::string>& texts)
            {
                for (const std::string& text : texts) options.pixels.push_back(parse_pixel(text));
            },
            "A pixel for --luminance: column and row from the upper left. May be repeated")
        ->type_name("X,Y")
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
    add_backend(command, options.backend, machine);
    command.add_option("--threads", options.threads, "Threads of the CPU backend; 0: one per core")
        ->type_name("T")
        ->check(CLI::Range(0, 1024))
        ->group(machine);
    command
        .add_option_function<std::string>(
            "--simd", [&options](const std::string& word) { options.simd = parse_simd(word); },
            "Vector width of the CPU backend: auto, scalar, avx2 or avx512; the result is the same")
        ->type_name("S")
        ->check(CLI::IsMember({"auto", "scalar", "avx2", "avx512"}))
        ->group(machine);
    command
        .add_option_function<std::string>(
            "--cuda-graph", [&options](const std::string& word) { options.cuda_graph = word == "on"; },
            "Queue the kernels of a step of the CUDA backend as one graph (on, the default) or one by one "
            "(off), with the time of each stage")
        ->type_name("G")
        ->check(CLI::IsMember({"on", "off"}))
        ->group(machine);
    static const std::map<std::string, Interop> kInterop = {
        {"auto", Interop::automatic}, {"on", Interop::on}, {"off", Interop::off}};
    command
        .add_option(
            "--interop", options.interop,
            "Simulate in the memory that GL draws from: auto (where it works), on (or fail), off (copy "
            "each frame)")
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
    add_sort(command, options.overrides);
    command.add_flag("--json", options.json, "As JSON");
}

void add_sorts(CLI::App& app, SortsOptions& options)
{
    CLI::App& command = *app.add_subcommand(
        "sorts", "Measure every sort of this machine: time beside its floor, bytes, order and picture");
    command.footer(kSortsExamples);
    const char* input = "What is sorted";
    command
        .add_option("--scene", options.scene,
                    "The frames of a scene before its own camera, and the pictures that each order makes")
        ->type_name("SCENE")
        ->group(input);
    command
        .add_option_function<std::vector<std::string>>(
            "--sizes",
            [&options](const std::vector<std::string>& texts)
            {
                for (const std::string& text : texts) options.sizes.push_back(parse_pairs(text));
            },
            "Made-up keys: numbers of pairs, 65K,1M unless given")
        ->delimiter(',')
        ->type_name("N,...")
        ->group(input);
    command
        .add_option_function<std::vector<std::string>>(
            "--patterns",
            [&options](const std::vector<std::string>& texts)
            {
                for (const std::string& text : texts) options.patterns.push_back(parse_pattern(text));
            },
            "Made-up keys: random, nearly-sorted, equal, camera-sweep; all unless given")
        ->delimiter(',')
        ->type_name("P,...")
        ->group(input);
    command.add_option("--strategies", options.strategies, "Only these sorts, as scenes name them")
        ->delimiter(',')
        ->type_name("S,...")
        ->group(input);
    command.add_flag("--table-4-1", options.table_4_1, "The report's Table 4.1 beside the same sizes here")
        ->group(input);
    add_scene_options(command, options.overrides);
    command.add_option("--out", options.out, "The table as x.csv or x.json. May be repeated")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->group("Output");
    add_backend(command, options.backend, "The machine");
}

void add_wind(CLI::App& app, WindOptions& options)
{
    CLI::App& command =
        *app.add_subcommand("wind", "Solve for the mean wind of a scene and write it to a file");
    command.add_option("scene", options.scene, "A TOML file, or the name of a shipped scene")
        ->required()
        ->type_name("SCENE");
    command
        .add_option("-o,--out", options.out, "NetCDF file: CF cell means, and the faces that QES-Plume reads")
        ->required()
        ->type_name("FILE");
    add_wind_files(command, options.overrides);
    add_backend(command, options.backend, "OPTIONS");
    command.add_option("--threads", options.threads, "Threads of the solver on the CPU; 0: one per core")
        ->type_name("T")
        ->check(CLI::Range(0, 1024));
    static const std::map<std::string, bool> kMethods = {{"multigrid", false}, {"sor", true}};
    command
        .add_option(
            "--method", options.relax,
            "multigrid (conjugate gradients with a multigrid cycle), or sor (red-black over-relaxation, for "
            "comparison)")
        ->type_name("M")
        ->transform(CLI::Transformer(kMethods).description(""));
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

void add_validate(CLI::App& app, ValidateOptions& options)
{
    CLI::App& command =
        *app.add_subcommand("validate", "Run the cases whose truth is known; exit code 1 if a check fails");
    command.add_option("--case", options.cases, "Only these cases; all unless given. May be repeated")
        ->delimiter(',')
        ->type_name("C");
    command
        .add_option("--particles", options.particles, "Flakes of each run; by default each case has its own")
        ->type_name("N")
        ->check(CLI::Range(100, 100'000'000));
    command.add_option("--dt", options.dt_s, "Time steps in s; by default each case has its own")
        ->delimiter(',')
        ->type_name("S,...")
        ->check(CLI::Range(1e-4, 10.0));
    command.add_option("--seed", options.seed, "Seed of every random number")
        ->type_name("X")
        ->capture_default_str();
    command.add_option("--threads", options.threads, "0: one per core")
        ->type_name("T")
        ->check(CLI::Range(0, 1024));
    command
        .add_option("--data", options.data,
                    "Folder of the field data (prairie_grass_neutral_arcs.csv); by default that of "
                    "SPINDRIFT_TEST_DATA")
        ->type_name("FOLDER")
        ->check(CLI::ExistingDirectory);
    command.add_flag("--json", options.json, "As JSON");
}

void add_report(CLI::App& app, ReportOptions& options)
{
    CLI::App& command = *app.add_subcommand(
        "report",
        "Measure time against error of advection and of the wind's solver: one HTML page with curves");
    command.add_option("-o,--out", options.out, "The page; it refers to nothing outside itself")
        ->required()
        ->type_name("FILE");
    command.add_option("--particles", options.particles, "Flakes of each run")
        ->type_name("N")
        ->check(CLI::Range(100, 10'000'000))
        ->capture_default_str();
    command.add_option("--cells", options.most_cells, "Solver: leave out grids of more cells along an edge")
        ->type_name("N")
        ->check(CLI::Range(16, 96))
        ->capture_default_str();
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
    SortsOptions sorts_options;
    add_sorts(app, sorts_options);
    WindOptions wind_options;
    add_wind(app, wind_options);
    add_calibrate(app, calibrate_options);
    ReportOptions report_options;
    add_report(app, report_options);
    ValidateOptions validate_options;
    add_validate(app, validate_options);
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
    if (app.got_subcommand("sorts")) return study_sorts(sorts_options);
    if (app.got_subcommand("wind")) return wind(wind_options);
    if (app.got_subcommand("calibrate")) return calibrate(calibrate_options);
    if (app.got_subcommand("validate")) return validate(validate_options);
    if (app.got_subcommand("report")) return report(report_options);
    if (app.got_subcommand("info")) return info();
    return list_scenes();
}

}  // namespace spindrift::app
