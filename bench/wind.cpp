// SPDX-License-Identifier: MIT
// The projection of a wind round twelve buildings: time against error for the multigrid solver and for
// red-black over-relaxation, beside a copy of the same bytes, and how the time grows with the grid.
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include "bench/walled_wind.h"
#include "cpu/poisson_solver.h"
#include "measure/timing.h"

namespace spindrift::bench
{

using namespace measure;

namespace
{

/// Building the grids counts for the multigrid; relaxation needs none.
double solve_ms(const WalledWind& c, const PoissonSettings& settings, std::vector<double>& x,
                PoissonResult& done)
{
    if (settings.method == PoissonMethod::multigrid)
        return time_ms([&] { done = cpu::PoissonSolver(c.problem).solve(c.b, x, settings); });
    cpu::PoissonSolver solver(c.problem);
    return time_ms([&] { done = solver.solve(c.b, x, settings); });
}

void report(benchmark::State& state, const WalledWind& c, const std::vector<double>& ms,
            const PoissonResult& done)
{
    std::vector<double> other(c.b.size()), copies;
    for (int i = 0; i < 21; ++i)
        copies.push_back(
            time_ms([&] { parallel_copy(other.data(), c.b.data(), c.b.size() * sizeof(double)); }));
    const double cells = static_cast<double>(c.problem.part.size());
    state.counters["iterations"] = done.iterations;
    state.counters["relative_residual"] = done.relative_residual;
    state.counters["ns_per_cell"] = quantile(ms, 0.5) * 1e6 / cells;
    state.counters["times_copy"] = quantile(ms, 0.5) / quantile(copies, 0.5);
}

void against_error(benchmark::State& state, PoissonMethod method, double factor, double tolerance)
{
    const WalledWind c = twelve_buildings(128, 128, 64);
    PoissonSettings settings;
    std::vector<double> truth, x, ms;
    PoissonResult done;
    settings.tolerance = 1e-10;
    cpu::PoissonSolver solver(c.problem);
    solver.solve(c.b, truth, settings);
    settings = {method, tolerance, 0, 20000, factor, {}};
    for (auto _ : state)
    {
        ms.push_back(solve_ms(c, settings, x, done));
        state.SetIterationTime(ms.back() * 1e-3);
    }
    report(state, c, ms, done);
    state.counters["velocity_error"] = velocity_error(solver.box(), solver.coefficients(), x, truth);
}

void against_size(benchmark::State& state, int nx, int ny, int nz)
{
    const WalledWind c = twelve_buildings(nx, ny, nz);
    std::vector<double> x, ms;
    PoissonResult done;
    for (auto _ : state)
    {
        ms.push_back(solve_ms(c, {}, x, done));
        state.SetIterationTime(ms.back() * 1e-3);
    }
    report(state, c, ms, done);
}

const int kRegistered = []
{
    const auto register_row = [](const std::string& name, auto... arguments)
    {
        return benchmark::RegisterBenchmark(name.c_str(), arguments...)
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
    };
    const std::string town = "wind/128x128x64/12-buildings/";
    for (const char* tolerance : {"1e-2", "1e-4", "1e-6", "1e-8"})
    {
        const double t = std::stod(tolerance);
        register_row(town + "multigrid/" + tolerance, against_error, PoissonMethod::multigrid, 1.0, t)
            ->Iterations(5);
        // 1.78 is the textbook factor of this use, 1.95 about the best one at 128 cells
        for (const char* factor : {"1.78", "1.95"})
            register_row(town + "sor-" + factor + "/" + tolerance, against_error,
                         PoissonMethod::over_relaxation, std::stod(factor), t)
                ->Iterations(1);
    }
    register_row("wind/size/1M", against_size, 128, 128, 64)->Iterations(3);
    register_row("wind/size/2M", against_size, 128, 128, 128)->Iterations(3);
    register_row("wind/size/4M", against_size, 256, 128, 128)->Iterations(2);
    register_row("wind/size/8M", against_size, 256, 256, 128)->Iterations(1);
    register_row("wind/size/16M", against_size, 256, 256, 256)->Iterations(1);
    return 0;
}();

}  // namespace

}  // namespace spindrift::bench
