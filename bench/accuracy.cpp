// SPDX-License-Identifier: MIT
// Time against error: advection in the well-mixed sinusoid over integrator, time step, precision and sampling
// of the field and re-ordering, and the solver over cells and tolerance (validation/study.h).
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "validation/study.h"

namespace spindrift::bench
{

namespace
{

constexpr std::uint64_t kFlakes = 20000;
constexpr double kSeconds = 12;

void advection(benchmark::State& state, const validation::AdvectionSetting& setting)
{
    validation::AdvectionPoint point;
    for (auto _ : state)
    {
        point = validation::measure_advection(setting, kFlakes, kSeconds);
        state.SetIterationTime(point.ns_per_flake_second * 1e-9 * kFlakes);  // of a simulated second
    }
    state.counters["ns_per_flake_second"] = point.ns_per_flake_second;
    state.counters["error"] = point.error;
    state.counters["noise"] = point.noise;
    state.counters["rogue_share"] = point.rogue_share;
    if (point.path_error_m >= 0) state.counters["path_error_m"] = point.path_error_m;
}

void solver(benchmark::State& state, const validation::SolverSetting& setting)
{
    validation::SolverPoint point;
    for (auto _ : state)
    {
        point = validation::measure_solver(setting, 0);
        state.SetIterationTime(point.ms * 1e-3);
    }
    state.counters["error"] = point.error;
    state.counters["iterations"] = point.iterations;
}

const int kRegistered = []
{
    const auto once = [](benchmark::internal::Benchmark* row)
    { row->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(1); };
    for (const validation::AdvectionSetting& setting : validation::advection_sweep())
        once(benchmark::RegisterBenchmark(("accuracy/advection/" + setting.name()).c_str(), advection,
                                          setting));
    for (const validation::SolverSetting& setting : validation::solver_sweep(96))
        once(benchmark::RegisterBenchmark(
            fmt::format("accuracy/solver/{}-cells/{:g}", setting.cells, setting.tolerance).c_str(), solver,
            setting));
    return 0;
}();

}  // namespace

}  // namespace spindrift::bench
