// SPDX-License-Identifier: MIT
// Advection in a wind grid of 128 x 128 x 64 cells: nanoseconds per flake and step, beside a plain copy of
// the same state on the same threads in the same run, and the error of the turbulence's variance.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include "bench/windy_box.h"
#include "cpu/cpu_backend.h"
#include "measure/timing.h"

namespace spindrift::bench
{

using namespace measure;

namespace
{

using namespace cpu;

constexpr std::uint64_t kFlakes = 1'000'000;
/// The eleven arrays of the state, one after the other, on the threads of the current arena.
void copy_state(const FlakeView& from, const FlakeView& to)
{
    const auto copy = [](auto* target, const auto* source) { parallel_copy(target, source, 4 * kFlakes); };
    copy(to.x, from.x), copy(to.y, from.y), copy(to.z, from.z);
    copy(to.q1, from.q1), copy(to.q2, from.q2), copy(to.q3, from.q3);
    copy(to.slip_x, from.slip_x), copy(to.slip_y, from.slip_y), copy(to.slip_z, from.slip_z);
    copy(to.id, from.id), copy(to.state, from.state);
}

/// Mean over the three components of (variance of q) - 1; chance alone gives a standard deviation of sqrt(2 /
/// 3N).
double variance_error(const FlakeView& f, std::size_t n)
{
    double sum = 0;
    for (const float* q : {f.q1, f.q2, f.q3})
        for (std::size_t i = 0; i < n; ++i) sum += static_cast<double>(q[i]) * static_cast<double>(q[i]);
    return sum / (3.0 * static_cast<double>(n)) - 1.0;
}

/// A million flakes on one variant of the kernels.
class Runner
{
  public:
    Runner(const World& world, Simd simd, int threads, std::uint32_t reorder_every_steps = 0)
        : memory_(kFlakes),
          backend_(make_cpu_backend(world, memory_.flakes(), memory_.draw_list(),
                                    {threads, simd, reorder_every_steps}))
    {
        for (int i = 0; i < 2; ++i) backend_->step();
    }
    double step_ms()
    {
        backend_->step();
        return backend_->times().advect;
    }
    /// Re-ordering included.
    double steps_ms(int steps)
    {
        return time_ms(
            [&]
            {
                for (int i = 0; i < steps; ++i) backend_->step();
            });
    }
    FlakeView flakes() const { return memory_.flakes(); }
    const Backend& backend() const { return *backend_; }

  private:
    HostFlakes memory_;
    std::unique_ptr<Backend> backend_;
};

/// Every round steps the row's own variant and those that it is compared with, then copies the state: what
/// else the machine does hits all of them. Ratios are medians over the rounds.
void advection(benchmark::State& state, Simd simd, int threads, bool turbulent)
{
    const World world = windy_box(kFlakes, turbulent);
    Runner runner(world, simd, threads);
    std::unique_ptr<Runner> scalar;
    std::unique_ptr<Runner> alone;
    if (simd != Simd::scalar && simd != Simd::scalar_fma)
        scalar = std::make_unique<Runner>(world, Simd::scalar_fma, threads);
    if (threads > 1) alone = std::make_unique<Runner>(world, simd, 1);
    const HostFlakes other(kFlakes);
    tbb::task_arena arena(threads);
    std::vector<double> step, copy, over_copy, over_scalar, over_alone;
    for (auto _ : state)
    {
        step.push_back(runner.step_ms());
        state.SetIterationTime(step.back() * 1e-3);
        copy.push_back(time_ms([&] { arena.execute([&] { copy_state(runner.flakes(), other.flakes()); }); }));
        over_copy.push_back(step.back() / copy.back());
        if (scalar) over_scalar.push_back(scalar->step_ms() / step.back());
        if (alone) over_alone.push_back(alone->step_ms() / step.back());
    }
    const double per_flake = 1e6 / static_cast<double>(runner.backend().counts().alive);
    state.counters["ns_per_flake_step"] = quantile(step, 0.5) * per_flake;
    state.counters["copy_ns"] = quantile(copy, 0.5) * per_flake;
    state.counters["times_copy"] = quantile(over_copy, 0.5);
    if (scalar) state.counters["faster_than_scalar_fma"] = quantile(over_scalar, 0.5);
    if (alone) state.counters["faster_than_1_thread"] = quantile(over_alone, 0.5);
    if (turbulent)
        state.counters["variance_error"] = variance_error(runner.flakes(), runner.backend().slots_used());
}

/// Every round takes `interval` steps with one re-ordering among them, and as many of a run that never
/// re-orders.
void reordering(benchmark::State& state, int threads, int interval)
{
    const World world = windy_box(kFlakes, true);
    Runner ordered(world, Simd::automatic, threads, static_cast<std::uint32_t>(interval));
    Runner never(world, Simd::automatic, threads);
    ordered.steps_ms(interval);
    std::vector<double> with, without, gain;
    for (auto _ : state)
    {
        with.push_back(ordered.steps_ms(interval) / interval);
        without.push_back(never.steps_ms(interval) / interval);
        state.SetIterationTime(with.back() * 1e-3);
        gain.push_back(without.back() / with.back());
    }
    const double per_flake = 1e6 / static_cast<double>(ordered.backend().counts().alive);
    state.counters["ns_per_flake_step"] = quantile(with, 0.5) * per_flake;
    state.counters["never_ns"] = quantile(without, 0.5) * per_flake;
    state.counters["faster_than_never"] = quantile(gain, 0.5);
}

const int kRegistered = []
{
    for (const int interval : {1, 4, 16, 64})
        for (const int threads : {1, 2})
        {
            const std::string name = "advect/128x128x64/1M/turbulent/reorder-" + std::to_string(interval) +
                                     "/" + std::to_string(threads) + "-thread";
            benchmark::RegisterBenchmark(name.c_str(), reordering, threads, interval)
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond)
                ->Iterations(interval > 16 ? 2 : 5);
        }
    for (const bool turbulent : {true, false})
        for (const Simd simd : available_simd())
            for (const int threads : {1, 2})
            {
                const std::string name = "advect/128x128x64/1M/" +
                                         std::string(turbulent ? "turbulent/" : "smooth/") + simd_name(simd) +
                                         "/" + std::to_string(threads) + "-thread";
                benchmark::RegisterBenchmark(name.c_str(), advection, simd, threads, turbulent)
                    ->UseManualTime()
                    ->Unit(benchmark::kMillisecond)
                    ->Iterations(simd == Simd::scalar ? 3 : 11);
            }
    return 0;
}();

}  // namespace

}  // namespace spindrift::bench
