// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "app/backend_choice.h"
#include "app/commands.h"
#include "app/engine.h"
#include "app/exit_codes.h"
#include "app/find_scene.h"
#include "core/error.h"
#include "cpu/wind_projection.h"
#include "scene/make_world.h"
#include "scene/write_wind.h"

namespace spindrift::app
{

namespace
{

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A line on stderr while the solver works: how far the residual has come on a logarithmic scale. Silent
/// where stderr is no terminal.
class ResidualBar
{
  public:
    explicit ResidualBar(double goal)
        : goal_(goal), terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now())
    {
    }
    ~ResidualBar()
    {
        if (drawn_) std::fputs("\n", stderr);
    }
    ResidualBar(const ResidualBar&) = delete;
    ResidualBar& operator=(const ResidualBar&) = delete;

    void show(int iteration, double residual)
    {
        if (!terminal_) return;
        drawn_ = true;
        constexpr int kCells = 30;
        const double share = residual > 0 ? std::log(residual) / std::log(goal_) : 1;
        const int filled = static_cast<int>(std::clamp(share, 0.0, 1.0) * kCells);
        fmt::print(stderr, "\rsolving [{:<{}}] residual {:.1e}, iteration {}, {:.1f} s\033[K",
                   std::string(static_cast<std::size_t>(filled), '='), kCells, residual, iteration,
                   seconds_since(start_));
        std::fflush(stderr);
    }

  private:
    double goal_;
    bool terminal_, drawn_ = false;
    Clock::time_point start_;
};

void print_summary(const scene::GriddedWind& wind, double solve_s, const std::string& backend,
                   const WindOptions& options)
{
    const StaggeredWind& grid = wind.solved.wind;
    const Projection& done = wind.solved.projection;
    fmt::print("{} x {} x {} cells of {:g} x {:g} x {:g} m, {} block(s) with zones, {}\n", grid.size.nx,
               grid.size.ny, grid.size.nz, grid.cell_m.x, grid.cell_m.y, grid.cell_m.z, wind.solved.blocks,
               wind.flow.stress.empty() ? "no turbulence" : "turbulent");
    if (wind.solved.from_cache)
        fmt::print("taken from {}\n", wind.solved.cached.string());
    else
    {
        fmt::print(
            "{} ({}): {} iterations, {:.3f} s, relative residual {:.1e}, largest divergence {:.2g} to {:.2g} "
            "1/s\n",
            options.relax ? "red-black over-relaxation" : "multigrid", backend, done.iterations, solve_s,
            done.relative_residual, done.before_per_s, done.after_per_s);
        if (!wind.solved.cached.empty()) fmt::print("kept in {}\n", wind.solved.cached.string());
    }
    fmt::print("wrote {}\n", options.out.string());
}

}  // namespace

int wind(const WindOptions& options)
{
    const scene::Scene scene = scene::read_scene(find_scene(options.scene), options.overrides);
    const BackendChoice choice = choose_backend(
        {.backend = options.backend, .cpu_option = options.threads ? "--threads" : ""}, cuda_support());
    cpu::ProjectionSettings settings;
    settings.threads = options.threads.value_or(0);
    if (choice.name == "cuda") settings.make_solver = cuda_poisson_solver();
    if (options.relax) settings.solver.method = PoissonMethod::over_relaxation;
    double solve_s = 0;
    const WindProjector project = [&](StaggeredWind& staggered)
    {
        ResidualBar bar(settings.solver.tolerance);
        settings.solver.progress = [&](int iteration, double residual) { bar.show(iteration, residual); };
        const auto start = Clock::now();
        const Projection done = cpu::make_divergence_free(staggered, settings);
        solve_s += seconds_since(start);
        return done;
    };
    scene::GriddedWind wind;
    scene::make_world(scene, scene::read_geometry(scene), project, &wind);
    if (wind.solved.wind.solid.empty())
        throw Error(
            fmt::format("{}: its wind is a formula, there is no grid to write; use wind.source = \"solve\" "
                        "or \"file\", or "
                        "wind.around_solids = true",
                        scene.file.string()));
    scene::write_wind(options.out, wind, scene.domain.min_m);
    print_summary(wind, solve_s, choice.name, options);
    return kOk;
}

}  // namespace spindrift::app
