// SPDX-License-Identifier: MIT
// Time against error: advection in the well-mixed sinusoid over integrator, time step, precision and sampling
// of the field and re-ordering, and the solver over cells and tolerance (validation/study.h).
#include <cmath>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/windy_box.h"
#include "core/flake_words.h"
#include "cpu/cpu_backend.h"
#include "measure/timing.h"
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

/// A million flakes in a wind of 64 MB: what re-ordering by cell is for. Its error is that of the
/// turbulence's variance; places and velocities are those of a run that never re-orders, which the hash of
/// both says.
void reordering(benchmark::State& state, int every)
{
    constexpr int kSteps = 32;
    constexpr std::uint64_t kMany = 1'000'000;
    const World world = windy_box(kMany, true);
    const cpu::HostFlakes memory(kMany);
    const auto backend = cpu::make_cpu_backend(world, memory.flakes(), memory.draw_list(),
                                               {1, cpu::Simd::automatic, static_cast<std::uint32_t>(every)});
    backend->step();
    double ms = 0;
    for (auto _ : state)
    {
        ms = measure::time_ms(
            [&]
            {
                for (int i = 0; i < kSteps; ++i) backend->step();
            });
        state.SetIterationTime(ms * 1e-3);
    }
    const FlakeView& f = memory.flakes();
    double square = 0, alive = 0;
    for (std::size_t i = 0; i < backend->slots_used(); ++i)
    {
        if (!is_alive(f.state[i])) continue;
        ++alive;
        for (const float q : {f.q1[i], f.q2[i], f.q3[i]})
            square += static_cast<double>(q) * static_cast<double>(q);
    }
    state.counters["ns_per_flake_second"] = ms * 1e6 / (alive * kSteps * world.step_s);
    state.counters["error"] = std::abs(square / (3 * alive) - 1);
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
    for (const int every : {0, 4, 16, 64})
        once(benchmark::RegisterBenchmark(fmt::format("accuracy/reorder/every-{}", every).c_str(), reordering,
                                          every));
    return 0;
}();

}  // namespace

}  // namespace spindrift::bench
