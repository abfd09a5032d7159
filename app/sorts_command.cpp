// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/camera_path.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/find_scene.h"
#include "app/progress_bar.h"
#include "app/sort_study.h"
#include "app/sort_tables.h"
#include "core/error.h"
#include "image/whole_file.h"
#include "measure/sort_keys.h"

namespace spindrift::app
{

namespace
{

constexpr std::array<std::size_t, 2> kUsualSizes{65'000, 1'000'000};
constexpr int kUsualFrames = 15;

void check_combinations(const SortsOptions& options)
{
    if (options.table_4_1 && (!options.scene.empty() || !options.sizes.empty() || !options.patterns.empty() ||
                              !options.strategies.empty()))
        throw Error(
            "--table-4-1 has sizes, keys and sorts of its own; leave out --scene, --sizes, --patterns and "
            "--strategies");
    const scene::SceneOverrides& o = options.overrides;
    if (options.scene.empty() &&
        (o.particles || o.seed || o.width_px || o.frames_per_s || o.winds_file || o.turbulence_file))
        throw Error(
            "--particles, --seed, --size, --fps, --wind and --turbulence change a scene; add --scene SCENE");
}

enum class Format
{
    csv,
    json,
};

Format format_of(const std::filesystem::path& file)
{
    if (file.extension() == ".csv") return Format::csv;
    if (file.extension() == ".json") return Format::json;
    throw Error(fmt::format("{}: is of no known kind; use a name that ends in .csv or .json", file.string()));
}

/// Throws Error for a backend or a sort that this machine has not got.
measure::WantedSorts wanted_sorts(const SortsOptions& options)
{
    measure::WantedSorts wanted;
    wanted.cpu = options.backend != "cuda";
    wanted.cuda = options.backend != "cpu";
    wanted.unsorted = true;
    const std::string no_cuda = measure::no_cuda_because();
    if (options.backend == "cuda" && !no_cuda.empty())
        throw Error(fmt::format("--backend cuda: {}; use --backend cpu or --backend auto", no_cuda));
    std::string names;
    std::vector<std::string> there;
    for (const measure::SortTraits& traits : measure::list_sorts(wanted))
        if (std::ranges::find(there, traits.strategy) == there.end())
        {
            names += (there.empty() ? "" : ", ") + traits.strategy;
            there.push_back(traits.strategy);
        }
    for (const std::string& name : options.strategies)
        if (std::ranges::find(there, name) == there.end())
            throw Error(
                fmt::format("--strategies {}: is no sort of this machine; use some of {}", name, names));
    wanted.strategies = options.table_4_1 ? table_4_1_strategies() : options.strategies;
    return wanted;
}

struct Study
{
    const SortsOptions& options;
    measure::WantedSorts wanted;
    int frames;
    std::string pictures_by = "none: no scene";
    std::vector<SortRow> rows = {};

    void add(std::vector<SortRow> more)
    {
        for (SortRow& row : more) rows.push_back(std::move(row));
    }
};

void run_pattern(Study& study, measure::KeyPattern pattern, std::size_t n)
{
    measure::PairSource source(pattern, n);
    const int usual_passes = scene::RenderSettings{}.sort_passes_per_frame;
    const int passes = study.options.overrides.sort_passes_per_frame.value_or(usual_passes);
    SortStudy sorts(study.wanted, passes, n, source.slots());
    ProgressBar bar(fmt::format("frames, {} {}", measure::pattern_name(pattern), size_name(n)),
                    static_cast<std::uint64_t>(study.frames));
    KeysOfFrame keys;
    for (int frame = 0; frame < study.frames; ++frame)
    {
        const auto pairs = source.next_frame();
        for (std::size_t i = 0; i < keys.pairs.size(); ++i)
        {
            keys.pairs[i].resize(pairs.size());
            std::ranges::transform(pairs, keys.pairs[i].begin(),
                                   [&](std::uint64_t pair)
                                   { return source.narrowed(pair, KeysOfFrame::kBits[i]); });
        }
        // Keys that stand still tell how far passes come in one frame; those that change, how they keep up.
        const bool first = frame == 0;
        sorts.add_frame(
            keys, first && source.changes() ? SortStart::exact : SortStart::as_kept,
            first || source.changes() ? SortStudy::Look::at_order_too : SortStudy::Look::at_times);
        bar.show(static_cast<std::uint64_t>(frame) + 1);
    }
    study.add(sorts.rows(std::string(measure::pattern_name(pattern)), size_name(n)));
}

std::vector<measure::KeyPattern> patterns_of(const SortsOptions& options)
{
    if (options.table_4_1) return {measure::KeyPattern::random};
    if (options.patterns.empty()) return {measure::kKeyPatterns.begin(), measure::kKeyPatterns.end()};
    return options.patterns;
}

void run_patterns(Study& study)
{
    std::vector<std::size_t> sizes = study.options.sizes;
    if (study.options.table_4_1)
        sizes.assign(kTable41Sizes.begin(), kTable41Sizes.end());
    else if (sizes.empty())
        sizes.assign(kUsualSizes.begin(), kUsualSizes.end());
    for (const measure::KeyPattern pattern : patterns_of(study.options))
        for (const std::size_t n : sizes) run_pattern(study, pattern, n);
}

void run_camera_path(Study& study)
{
    CameraPath path(scene::read_scene(find_scene(study.options.scene), study.options.overrides));
    study.pictures_by = path.pictures_by();
    SortStudy sorts(study.wanted, path.scene().render.sort_passes_per_frame, path.capacity(),
                    path.capacity());
    const PictureError error = [&](std::span<const std::uint64_t> order, std::span<const std::uint64_t> exact)
    { return path.picture_error(order, exact); };
    ProgressBar bar("frames, " + path.scene().name, static_cast<std::uint64_t>(study.frames));
    for (int frame = 0; frame < study.frames; ++frame)
    {
        path.go_to(static_cast<std::uint64_t>(frame));
        sorts.add_frame(path.keys(), path.start(), SortStudy::Look::at_order_too,
                        path.draws() ? error : PictureError{});
        bar.show(static_cast<std::uint64_t>(frame) + 1);
    }
    study.add(sorts.rows("camera path of " + path.scene().name));
}

void write_files(const Study& study)
{
    for (const std::filesystem::path& file : study.options.out)
    {
        const std::string text =
            format_of(file) == Format::csv ? to_csv(study.rows) : to_json(study.rows, study.pictures_by);
        image::write_whole(file, std::as_bytes(std::span(text)));
        fmt::print("wrote {}\n", file.string());
    }
}

}  // namespace

int study_sorts(const SortsOptions& options)
{
    check_combinations(options);
    for (const std::filesystem::path& file : options.out)
    {
        format_of(file);
        const image::AsideFile probe(file);  // must not find out at the end that it cannot be written
    }
    Study study{options, wanted_sorts(options), options.overrides.frames.value_or(kUsualFrames)};
    if (options.scene.empty() || !options.sizes.empty() || !options.patterns.empty()) run_patterns(study);
    if (!options.scene.empty()) run_camera_path(study);

    fmt::print("{}", options.table_4_1 ? table_4_1(study.rows) : to_text(study.rows));
    if (const std::string no_cuda = measure::no_cuda_because(); options.backend == "auto" && !no_cuda.empty())
        fmt::print("\nCUDA sorts: none ({})\n", no_cuda);
    if (!options.scene.empty()) fmt::print("Pictures by: {}\n", study.pictures_by);
    write_files(study);
    return kOk;
}

}  // namespace spindrift::app
