// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "bench/drawn_row.h"
#include "bench/drawn_scene.h"
#include "bench/flake_field.h"
#include "measure/timing.h"

// Rows lamps-N/PATH/AIR/1M: drawing the flakes of a sky of a million, four in five of them in sight, by
// either path under N street lamps of 16 m range, four abreast. x_one_lamp: over the time of the same flakes
// under one of the lamps, x_dark over that without any. draw_ms is the whole picture, in thick air with the
// lamps' glow on every pixel. Sort and simulation are not in it.

namespace spindrift::bench
{

using namespace measure;

namespace
{

constexpr int kAbreast = 4, kRows = 16;
constexpr int kRounds = 3;

struct Row
{
    int lamps;
    const char* path;
    const char* air;
};

std::string lamp_text(int column, int row)
{
    return fmt::format(
        "[[light]]\nname = \"{} {}\"\nkind = \"point\"\nposition_m = [{}, {}, 6]\n"
        "intensity_w_sr = [15, 9, 3]\nrange_m = 16\n",
        column, row, 62 + 12 * column, 24 + 8 * row);
}

scene::Scene street(const Row& row, int lamps)
{
    FlakeField field{.flakes = 1'000'000,
                     .rate_mm_h = 2,
                     .weight = 50,
                     .domain_m = {160, 160, 40},
                     .centre_m = {80, 80, 10},
                     .size_m = {100, 140, 20},
                     .far_m = 400,
                     .eye_m = {80, 8, 6},
                     .look_at_m = {80, 100, 8},
                     .sections = {},
                     .render = {}};
    field.sections = R"([sky]
zenith_w_sr_m2 = [0.003, 0.004, 0.008]
horizon_w_sr_m2 = [0.016, 0.015, 0.017]
ambient_w_sr_m2 = [0.014, 0.015, 0.02]
)";
    if (row.air == std::string_view("thick"))
        field.sections += "[air]\nsource = \"visibility\"\nvisibility_m = 150\n";
    // The same lamps whatever their number, from the middle of the street outwards.
    for (int i = 0; i < lamps; ++i)
    {
        const int at = (i * (kAbreast * kRows / lamps) + kAbreast * kRows / 3) % (kAbreast * kRows);
        field.sections += lamp_text(at % kAbreast, at / kAbreast);
    }
    field.render = fmt::format("flake_path = \"{}\"\nflake_scale = 7\n", row.path);
    return field.scene();
}

struct Times
{
    std::vector<double> draw, flakes, grids;
    std::uint64_t drawn = 0;
    std::string driver;
};

/// Milliseconds of whole pictures, and of what flakes add to scene, sky and air.
Times measure(const Row& row, int lamps)
{
    DrawnScene scene(street(row, lamps));
    for (int i = 0; i < 4; ++i) scene.step();
    scene.prepare();
    scene.draw();
    Times times;
    times.drawn = scene.drawn();
    times.driver = scene.driver();
    for (int round = 0; round < kRounds; ++round)
    {
        times.draw.push_back(time_ms([&] { scene.draw(); }));
        // Pixels and flakes share the grids of glow: flakes pay for all of them here.
        const double air = time_ms([&] { scene.draw_passes({"glow grids", "fog", "airlight"}); });
        const double all = time_ms(
            [&] {
                scene.draw_passes({"glow grids", "fog", "airlight", "flakes", "tiles"});
            });
        const double nothing = time_ms([&] { scene.draw_passes({}); });
        const double grids = time_ms([&] { scene.draw_passes({"glow grids"}); });
        times.grids.push_back(grids - nothing);
        times.flakes.push_back(all - air + grids - nothing);
    }
    return times;
}

void under_lamps(benchmark::State& state, const Row& row)
{
    const Times many = measure(row, row.lamps), one = measure(row, 1), none = measure(row, 0);
    const double flakes = quantile(many.flakes, 0.5), draw = quantile(many.draw, 0.5);
    for (auto _ : state) state.SetIterationTime(flakes * 1e-3);
    state.counters["x_one_lamp"] = flakes / quantile(one.flakes, 0.5);
    state.counters["x_dark"] = flakes / quantile(none.flakes, 0.5);
    state.counters["grids_ms"] = quantile(many.grids, 0.5);
    state.counters["draw_ms"] = draw;
    state.counters["draw_x_one_lamp"] = draw / quantile(one.draw, 0.5);
    state.counters["drawn"] = static_cast<double>(many.drawn);
    state.SetLabel(many.driver);
}

bool register_rows()
{
    for (const auto& [path, air] : {std::pair{"tiles", "clear"}, std::pair{"tiles", "thick"},
                                    std::pair{"raster", "clear"}, std::pair{"raster", "thick"}})
        for (const int lamps : {1, 4, 16, 64})
        {
            const Row row{lamps, path, air};
            add_drawn_row(fmt::format("lamps-{}/{}/{}/1M", lamps, path, air),
                          [row](benchmark::State& state) { under_lamps(state, row); });
        }
    return true;
}

[[maybe_unused]] const bool registered = register_rows();

}  // namespace

}  // namespace spindrift::bench
