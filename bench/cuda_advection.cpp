// SPDX-License-Identifier: MIT
// Advection on a CUDA device: the rows of bench/advection.cpp, by the device's clock, beside a device copy of
// the same state.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/device_copy.h"
#include "bench/windy_box.h"
#include "cuda/cuda_backend.h"
#include "cuda/device.h"
#include "cuda/flake_memory.h"
#include "measure/timing.h"

namespace spindrift::bench
{

using namespace measure;

namespace
{

/// What a turbulent step must move of a flake's state: eleven arrays read, all but the ids written.
constexpr double kStateBytes = 2 * static_cast<double>(kStateBytesPerFlake) - 4;

class Runner
{
  public:
    Runner(const World& world, const gpu::CudaOptions& options)
        : memory_(world.capacity), backend_(gpu::make_cuda_backend(world, memory_, options))
    {
        for (int i = 0; i < 2; ++i) step();
    }
    StageTimes step()
    {
        backend_->step();
        backend_->finish();
        return backend_->times();
    }
    double alive() const { return static_cast<double>(backend_->counts().alive); }

  private:
    gpu::DeviceFlakes memory_;
    std::unique_ptr<Backend> backend_;
};

/// The kernels one by one, each timed; the flakes as they came, or re-ordered by cell every so many steps.
void advection(benchmark::State& state, World (*box)(std::uint64_t, bool), std::uint64_t flakes,
               bool turbulent, std::uint32_t interval)
{
    Runner runner(box(flakes, turbulent), {gpu::StepGraph::off, interval});
    for (std::uint32_t i = 0; i < interval; ++i) runner.step();
    DeviceCopy state_copy(flakes * kStateBytesPerFlake);
    std::vector<double> advect, whole, copy, over_copy;
    for (auto _ : state)
    {
        const StageTimes times = runner.step();
        advect.push_back(times.advect);
        whole.push_back(times.step);
        copy.push_back(state_copy.ms());
        over_copy.push_back(advect.back() / copy.back());
        state.SetIterationTime(advect.back() * 1e-3);
    }
    const double per_flake = 1e6 / runner.alive();
    const double copied = 2 * static_cast<double>(kStateBytesPerFlake);
    state.counters["ns_per_flake_step"] = quantile(advect, 0.5) * per_flake;
    state.counters["copy_ns"] = quantile(copy, 0.5) * per_flake;
    state.counters["times_copy"] = quantile(over_copy, 0.5);
    state.counters["state_bytes"] = kStateBytes;
    state.counters["share_of_copy_bandwidth"] = kStateBytes / copied / quantile(over_copy, 0.5);
    state.counters["whole_step_ns"] = quantile(whole, 0.5) * per_flake;
}

/// Whole steps, with and without a graph, re-ordered or not, in rounds of `interval` steps.
void whole_steps(benchmark::State& state, std::uint64_t flakes, gpu::StepGraph graph, std::uint32_t interval)
{
    const World world = windy_box(flakes, true);
    Runner runner(world, {graph, interval});
    Runner never(world, {graph, 0});
    const int steps = interval == 0 ? 1 : static_cast<int>(interval);
    const auto mean_ms = [steps](Runner& of)
    {
        double sum = 0;
        for (int i = 0; i < steps; ++i) sum += of.step().step;
        return sum / steps;
    };
    mean_ms(runner);
    std::vector<double> with, gain;
    for (auto _ : state)
    {
        with.push_back(mean_ms(runner));
        gain.push_back(mean_ms(never) / with.back());
        state.SetIterationTime(with.back() * 1e-3);
    }
    state.counters["ns_per_flake_step"] = quantile(with, 0.5) * 1e6 / runner.alive();
    if (interval > 0) state.counters["faster_than_never"] = quantile(gain, 0.5);
}

template <class Row, class... Arguments>
void add_row(const std::string& name, int rounds, const Row& row, Arguments... arguments)
{
    benchmark::RegisterBenchmark(name.c_str(), row, arguments...)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(rounds);
}

const int kRegistered = []
{
    if (gpu::find_devices().list.empty()) return 0;
    // ten thousand: launches count for more than flakes there, and a graph should show
    for (const auto& [crowd, flakes] :
         {std::pair{"10K", std::uint64_t{10'000}}, {"1M", 1'000'000}, {"8M", 8'000'000}})
    {
        const std::string size = std::string("advect/128x128x64/") + crowd + "/";
        for (const bool turbulent : {true, false})
        {
            const std::string row = std::string(turbulent ? "turbulent" : "smooth") + "/cuda";
            add_row(size + row, 31, advection, windy_box, flakes, turbulent, 0U);
            add_row(size + row + "/reorder-16", 32, advection, windy_box, flakes, turbulent, 16U);
            add_row(std::string("advect/profile/") + crowd + "/" + row, 31, advection, profile_box, flakes,
                    turbulent, 0U);
        }
        const std::string steps = size + "turbulent/cuda/step/";
        add_row(steps + "kernel-by-kernel", 31, whole_steps, flakes, gpu::StepGraph::off, 0U);
        add_row(steps + "graph", 31, whole_steps, flakes, gpu::StepGraph::on, 0U);
        for (const std::uint32_t interval : {1U, 4U, 16U, 64U, 256U})
            add_row(steps + "graph/reorder-" + std::to_string(interval), 5, whole_steps, flakes,
                    gpu::StepGraph::on, interval);
    }
    return 0;
}();

}  // namespace

}  // namespace spindrift::bench
