// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "bench/drawn_row.h"
#include "bench/drawn_scene.h"
#include "bench/flake_field.h"
#include "image/compare.h"
#include "image/flip.h"
#include "image/write.h"
#include "measure/timing.h"

// Rows blending/SCENE/METHOD/PATH: how flakes are put over each other. Time: culling, sort (of the method
// that needs one) and drawing of 60 000 flakes, 640x360; x_over: over that of sorted ones in the same row.
// Errors against the reference renderer, flakes in exact order: relative L2 in linear light, and FLIP of what
// a display shows of it. In the scene `lamp` flakes stand thick before and behind a lamp, so that order
// matters; in `even` the same flakes hang in the same light.

namespace spindrift::bench
{

using namespace measure;

namespace
{

constexpr int kFrames = 15;

struct Row
{
    const char *scene, *method, *path;
    int samples;  ///< stochastic
};

constexpr std::string_view kLamp = R"([[light]]
name = "lamp"
kind = "point"
position_m = [20, 12, 6]
intensity_w_sr = [40, 22, 8]
range_m = 30
g = 0.6
[sky]
zenith_w_sr_m2 = [0.02, 0.03, 0.05]
horizon_w_sr_m2 = [0.02, 0.03, 0.05]
ambient_w_sr_m2 = [0.02, 0.03, 0.06]
)";
constexpr std::string_view kEven = R"([sky]
zenith_w_sr_m2 = [0.1, 0.15, 0.25]
horizon_w_sr_m2 = [0.2, 0.2, 0.2]
ambient_w_sr_m2 = [0.6, 0.62, 0.66]
)";

scene::Scene flakes_round_a_lamp(const Row& row, std::string_view method)
{
    FlakeField field{.flakes = 60'000,
                     .rate_mm_h = 4,
                     .weight = 1000,
                     .domain_m = {40, 40, 20},
                     .centre_m = {20, 12, 6},
                     .size_m = {16, 20, 12},
                     .eye_m = {20, 1, 6},
                     .look_at_m = {20, 12, 6},
                     .sections = {},
                     .render = {}};
    field.sections = row.scene == std::string_view("lamp") ? kLamp : kEven;
    field.render = fmt::format(
        "width_px = 640\nheight_px = 360\nflake_scale = 16\nblending = \"{}\"\nflake_path = \"{}\"\n", method,
        row.path);
    if (method == "stochastic") field.render += fmt::format("samples = {}\n", row.samples);
    return field.scene();
}

struct Drawn
{
    double ms;
    image::Image picture;
};

Drawn draw(DrawnScene& scene)
{
    for (int i = 0; i < 3; ++i) scene.step();
    std::vector<double> ms;
    for (int frame = -3; frame < kFrames; ++frame)
    {
        const double time = time_ms(
            [&]
            {
                scene.prepare();
                scene.draw();
            });
        if (frame >= 0) ms.push_back(time);
    }
    return {quantile(ms, 0.5), scene.picture()};
}

void blend(benchmark::State& state, const Row& row)
{
    image::Image truth;
    double over_ms = 0;
    {
        DrawnScene sorted(flakes_round_a_lamp(row, "over"));
        over_ms = draw(sorted).ms;
        truth = sorted.reference_picture();
    }
    DrawnScene scene(flakes_round_a_lamp(row, row.method));
    const Drawn drawn = draw(scene);
    for (auto _ : state) state.SetIterationTime(drawn.ms * 1e-3);
    state.counters["x_over"] = drawn.ms / over_ms;
    state.counters["error_relative_l2"] = image::compare(drawn.picture, truth, 1e-2).relative_l2;
    state.counters["error_flip"] = image::flip(image::to_srgb8(drawn.picture), image::to_srgb8(truth));
    state.counters["drawn"] = static_cast<double>(scene.drawn());
    state.SetLabel(scene.driver());
    if (const char* folder = std::getenv("SPINDRIFT_BENCH_PICTURES"))
    {
        image::write_png(
            fmt::format("{}/{}-{}-{}-{}.png", folder, row.scene, row.method, row.samples, row.path),
            image::to_srgb8(drawn.picture));
        image::write_png(fmt::format("{}/{}-truth.png", folder, row.scene), image::to_srgb8(truth));
    }
}

void add(const Row& row)
{
    const std::string samples = row.samples > 0 ? fmt::format("-{}", row.samples) : std::string();
    add_drawn_row(fmt::format("blending/{}/{}{}/{}", row.scene, row.method, samples, row.path),
                  [row](benchmark::State& state) { blend(state, row); });
}

bool register_rows()
{
    for (const char* path : {"tiles", "raster"})
        for (const char* scene : {"lamp", "even"})
        {
            for (const char* method : {"over", "additive", "weighted"}) add({scene, method, path, 0});
            for (const int samples : {2, 8, 16}) add({scene, "stochastic", path, samples});
        }
    return true;
}

[[maybe_unused]] const bool registered = register_rows();

}  // namespace

}  // namespace spindrift::bench
