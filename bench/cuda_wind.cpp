// SPDX-License-Identifier: MIT
// The projection of a wind on a CUDA device: the rows of bench/wind.cpp, by the device's clock, beside a
// device copy.
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/device_copy.h"
#include "bench/walled_wind.h"
#include "cuda/device.h"
#include "cuda/poisson_solver.h"
#include "measure/timing.h"

namespace spindrift::bench
{

using namespace measure;

namespace
{

/// Solving alone: the grids are made on the processor and copied once.
void solve(benchmark::State& state, int nx, int ny, int nz, PoissonSettings settings)
{
    const WalledWind c = twelve_buildings(nx, ny, nz);
    const gpu::Stream stream;
    std::unique_ptr<PoissonSolver> solver;
    const double grids_ms = time_ms([&] { solver = gpu::make_poisson_solver(c.problem, stream); });
    std::vector<double> truth, x, ms, copies;
    PoissonSettings exact;
    exact.tolerance = 1e-10;
    solver->solve(c.b, truth, exact);
    PoissonResult done;
    gpu::Event begin(gpu::Event::Timing::on), end(gpu::Event::Timing::on);
    for (auto _ : state)
    {
        begin.record(stream);
        done = solver->solve(c.b, x, settings);
        end.record(stream);
        end.wait();
        ms.push_back(end.ms_since(begin));
        state.SetIterationTime(ms.back() * 1e-3);
    }
    DeviceCopy copy(c.b.size() * sizeof(double));
    for (int i = 0; i < 21; ++i) copies.push_back(copy.ms());
    state.counters["iterations"] = done.iterations;
    state.counters["relative_residual"] = done.relative_residual;
    state.counters["ns_per_cell"] = quantile(ms, 0.5) * 1e6 / static_cast<double>(c.problem.part.size());
    state.counters["times_copy"] = quantile(ms, 0.5) / quantile(copies, 0.5);
    state.counters["grids_ms"] = grids_ms;
    state.counters["velocity_error"] = velocity_error(solver->box(), solver->coefficients(), x, truth);
}

const int kRegistered = []
{
    if (gpu::find_devices().list.empty()) return 0;
    const auto add =
        [](const std::string& name, int rounds, int nx, int ny, int nz, const PoissonSettings& settings)
    {
        benchmark::RegisterBenchmark(name.c_str(), solve, nx, ny, nz, settings)
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(rounds);
    };
    for (const char* tolerance : {"1e-2", "1e-4", "1e-6", "1e-8"})
    {
        PoissonSettings settings;
        settings.tolerance = std::stod(tolerance);
        const std::string town = "wind/128x128x64/12-buildings/cuda/";
        add(town + "multigrid/" + tolerance, 5, 128, 128, 64, settings);
        settings.method = PoissonMethod::over_relaxation;
        settings.over_relaxation = 1.95;  // about the best one at 128 cells
        add(town + "sor-1.95/" + tolerance, 1, 128, 128, 64, settings);
    }
    add("wind/size/32K/cuda", 3, 48, 40, 16, {});
    add("wind/size/1M/cuda", 3, 128, 128, 64, {});
    add("wind/size/4M/cuda", 3, 256, 128, 128, {});
    add("wind/size/16M/cuda", 3, 256, 256, 256, {});
    return 0;
}();

}  // namespace

}  // namespace spindrift::bench
