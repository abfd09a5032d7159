// SPDX-License-Identifier: MIT
// Tracers seeded evenly in the air of `town`, whose wind is solved for with wakes and recirculation: a wind
// free of divergence keeps them even. Docs: docs/validation.md.
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "cpu/wind_projection.h"
#include "scene/make_world.h"
#include "validation/all_cases.h"
#include "validation/worlds.h"

namespace spindrift::validation
{

namespace
{

/// Blocks of air of kBlock_m, away from the open borders by as far as flakes come from outside.
constexpr double kBlock_m = 10, kSeconds = 4, kMargin_m = 50;

World seeded_town(const Settings& settings, double dt, bool turbulent)
{
    scene::Scene scene = scene::read_scene(settings.scene_folder / "town.toml");
    scene.wind.source = scene::WindSource::solve;
    scene.wind.around_solids = false;
    scene.wind.turbulence = turbulent;
    World w = scene::make_world(scene, scene::read_geometry(scene), cpu::project_wind());
    w.step_s = dt;
    w.seed = settings.seed;
    w.capacity = settings.particles;
    w.on_leave = OnLeave::remove;
    w.snow.fall_speed_m_s = 0;
    w.snow.fall_speed_spread_m_s = 0;
    w.ground = {Contact::bounce, 1};
    for (Surface& surface : w.surfaces) surface = {Contact::bounce, 1};
    w.emitters.clear();
    w.anchors.clear();
    add_burst(w, {0, 0, 0}, w.size_m);
    return w;
}

/// Flakes by block; flakes near the open borders do not count.
std::vector<double> by_block(const World& world, const FlakeRun& run)
{
    const auto blocks = [](double length) { return static_cast<int>(length / kBlock_m); };
    const int nx = blocks(world.size_m.x - 2 * kMargin_m), ny = blocks(world.size_m.y - 2 * kMargin_m),
              nz = blocks(30);
    std::vector<double> count(static_cast<std::size_t>(nx * ny * nz), 0);
    for (std::size_t i = 0; i < run.slots(); ++i)
    {
        if (!run.alive(i)) continue;
        const double x = (run.flakes().x[i] - kMargin_m) / kBlock_m,
                     y = (run.flakes().y[i] - kMargin_m) / kBlock_m, z = run.flakes().z[i] / kBlock_m;
        if (x < 0 || y < 0 || x >= nx || y >= ny || z >= nz) continue;
        ++count[static_cast<std::size_t>((static_cast<int>(z) * ny + static_cast<int>(y)) * nx +
                                         static_cast<int>(x))];
    }
    return count;
}

}  // namespace

Outcome validate_uniform_wind(const Settings& settings)
{
    Outcome outcome;
    for (const double dt : settings.dt_s)
        for (const bool turbulent : {false, true})
        {
            const World world = seeded_town(settings, dt, turbulent);
            FlakeRun run(world, settings);
            run.step();
            const std::vector<double> before = by_block(world, run);
            run.steps(static_cast<std::uint64_t>(kSeconds / dt));
            const std::vector<double> after = by_block(world, run);
            double chi_square = 0, blocks = 0, worst = 0;
            for (std::size_t b = 0; b < before.size(); ++b)
            {
                const double sum = before[b] + after[b];
                if (before[b] < 30) continue;  // inside a house
                ++blocks;
                const double off = (after[b] - before[b]) * (after[b] - before[b]) / sum;
                chi_square += off;
                worst = std::max(worst, std::sqrt(off));
            }
            const std::string which =
                fmt::format("dt = {:g} s, {}: ", dt, turbulent ? "turbulent" : "mean wind alone");
            const double noise = std::sqrt(2 / blocks);
            outcome.checks.push_back({which + "chi-square of blocks of air / dof", chi_square / blocks, 1,
                                      noise, 5 * noise, Side::above});
            outcome.checks.push_back({which + "worst block, in sd", worst, 0, 1, 5, Side::above});
            outcome.checks.push_back({which + "rogue or vanished",
                                      static_cast<double>(run.rogue() + run.backend().counts().vanished), 0,
                                      0, 0});
        }
    return outcome;
}

}  // namespace spindrift::validation
