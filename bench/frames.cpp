// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "bench/drawn_row.h"
#include "bench/drawn_scene.h"
#include "image/compare.h"
#include "measure/timing.h"

// Rows frame/SCENE/SIZE/FLAKES: a whole frame (simulation steps, culling, sort, every drawing pass until the
// picture is there), its stages, and the bare draw of the same points in the same run; medians over the
// frames. Rows picture/SCENE/SIZE/FLAKES: drawing alone, with its error: relative L2 in linear light against
// the reference renderer.

namespace spindrift::bench
{

using namespace measure;

namespace
{

constexpr int kWarmUpFrames = 5;
constexpr int kFrames = 30;
/// In the order of measuring: those that develop the whole picture before those that draw parts of it anew.
constexpr std::array kPasses{"exposure", "bloom", "tone", "scene", "sky", "fade", "flakes", "tiles"};

struct Row
{
    const char* scene;
    int width_px, height_px;
    std::uint64_t particles;
};

std::string row_name(const char* what, const Row& row)
{
    return std::string(what) + "/" + row.scene + "/" + std::to_string(row.width_px) + "x" +
           std::to_string(row.height_px) + "/" + std::to_string(row.particles / 1000) + "K";
}

/// Milliseconds by frame.
struct FrameTimes
{
    std::vector<double> whole, steps, prepare, draw, bare, read, post;
    std::array<std::vector<double>, kPasses.size()> passes;  ///< each alone
};

FrameTimes measure_frames(DrawnScene& scene, BarePoints& bare)
{
    FrameTimes times;
    for (int frame = -kWarmUpFrames; frame < kFrames; ++frame)
    {
        const double steps = time_ms(
            [&]
            {
                for (int i = 0; i < scene.steps_per_frame(); ++i) scene.step();
            });
        const double prepare = time_ms([&] { scene.prepare(); });
        const double draw = time_ms([&] { scene.draw(); });
        const double read = time_ms([&] { benchmark::DoNotOptimize(scene.display().rgb.data()); });
        const double post = time_ms([&] { scene.draw_passes({"exposure", "bloom", "tone"}); });
        std::array<double, kPasses.size()> passes{};
        for (std::size_t i = 0; i < kPasses.size(); ++i)
            passes[i] = time_ms([&] { scene.draw_passes({kPasses[i]}); });
        bare.upload(scene.points());
        const double alone = time_ms([&] { bare.draw(); });
        if (frame < 0) continue;
        times.whole.push_back(steps + prepare + draw);
        times.steps.push_back(steps);
        times.prepare.push_back(prepare);
        times.draw.push_back(draw);
        times.read.push_back(read);
        times.bare.push_back(alone);
        times.post.push_back(post);
        for (std::size_t i = 0; i < kPasses.size(); ++i) times.passes[i].push_back(passes[i]);
    }
    return times;
}

void whole_frame(benchmark::State& state, const Row& row)
{
    DrawnScene scene(row.scene, row.particles, row.width_px, row.height_px);
    BarePoints bare(row.width_px, row.height_px);
    const FrameTimes times = measure_frames(scene, bare);
    const double whole = quantile(times.whole, 0.5);
    for (auto _ : state) state.SetIterationTime(whole * 1e-3);
    state.counters["x_bare"] = whole / quantile(times.bare, 0.5);
    state.counters["bare_ms"] = quantile(times.bare, 0.5);
    state.counters["steps_ms"] = quantile(times.steps, 0.5);
    state.counters["prepare_ms"] = quantile(times.prepare, 0.5);
    state.counters["draw_ms"] = quantile(times.draw, 0.5);
    for (std::size_t i = 0; i < kPasses.size(); ++i)
        state.counters[std::string(kPasses[i]) + "_ms"] = quantile(times.passes[i], 0.5);
    state.counters["post_ms"] = quantile(times.post, 0.5);
    state.counters["post_share"] = quantile(times.post, 0.5) / whole;
    state.counters["read_ms"] = quantile(times.read, 0.5);
    state.counters["p95_ms"] = quantile(times.whole, 0.95);
    state.counters["drawn"] = static_cast<double>(scene.drawn());
    state.SetLabel(scene.driver());
}

void picture(benchmark::State& state, const Row& row)
{
    DrawnScene scene(row.scene, row.particles, row.width_px, row.height_px);
    for (int i = 0; i < 60; ++i) scene.step();
    scene.prepare();
    scene.draw();
    const image::Difference off = image::compare(scene.picture(), scene.reference_picture(), 1e-2);
    std::vector<double> draw_ms;
    for (int frame = 0; frame < kFrames; ++frame) draw_ms.push_back(time_ms([&] { scene.draw(); }));
    for (auto _ : state) state.SetIterationTime(quantile(draw_ms, 0.5) * 1e-3);
    state.counters["error_relative_l2"] = off.relative_l2;
    state.counters["error_relative_l2_rest"] = off.rest_relative_l2;
    state.counters["error_share_above_1e-2"] = off.share_above;
    state.counters["drawn"] = static_cast<double>(scene.drawn());
    state.SetLabel(scene.driver());
}

bool register_rows()
{
    constexpr std::array frames{Row{"town", 1280, 720, 100'000}, Row{"canyon", 1280, 720, 100'000},
                                Row{"night", 1280, 720, 200'000}};
    constexpr std::array pictures{Row{"town", 320, 180, 4'000}, Row{"canyon", 320, 180, 4'000},
                                  Row{"calm", 320, 180, 4'000}};
    const auto add = [](const char* what, const Row& row, auto body)
    { add_drawn_row(row_name(what, row), [=](benchmark::State& state) { body(state, row); }); };
    for (const Row& row : frames) add("frame", row, whole_frame);
    for (const Row& row : pictures) add("picture", row, picture);
    return true;
}

[[maybe_unused]] const bool registered = register_rows();

}  // namespace

}  // namespace spindrift::bench
