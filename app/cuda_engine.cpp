// SPDX-License-Identifier: MIT
#include <utility>

#include <fmt/format.h>

#include "app/engine.h"
#include "cuda/cuda_backend.h"
#include "cuda/device.h"
#include "cuda/flake_memory.h"
#include "cuda/interop/gl_device.h"
#include "cuda/interop/sharing.h"
#include "cuda/poisson_solver.h"

namespace spindrift::app
{

namespace
{

std::string version_text(int version)
{
    return version == 0 ? "none" : fmt::format("{}.{}", version / 1000, version % 1000 / 10);
}

/// The device's memory; nothing is drawn.
class UndrawnMemory final : public FlakeMemory
{
  public:
    explicit UndrawnMemory(std::size_t capacity) : device_(capacity) {}
    gpu::FlakeMemory& on_device() { return device_; }
    std::size_t bytes() const override { return device_.bytes(); }
    const gl::FlakeBuffers* drawn_from() const override { return nullptr; }
    void hand_over(std::size_t, const DrawList&) override {}

  private:
    gpu::DeviceFlakes device_;
};

/// Memory that GL draws from.
class DrawnMemory final : public FlakeMemory
{
  public:
    DrawnMemory(std::unique_ptr<gpu::DrawnMemory> memory, bool shared)
        : memory_(std::move(memory)), shared_(shared)
    {
    }
    gpu::FlakeMemory& on_device() { return *memory_; }
    std::size_t bytes() const override { return memory_->bytes(); }
    const gl::FlakeBuffers* drawn_from() const override { return &memory_->drawn_from(); }
    void hand_over(std::size_t, const DrawList&) override {}  // Backend::close does
    std::uint64_t readable(const DrawList& list) const override
    {
        return shared_ ? list.slots : list.count;  // a copy holds what is drawn, from slot 0 on
    }

  private:
    std::unique_ptr<gpu::DrawnMemory> memory_;
    bool shared_;
};

gpu::SharingWish wish_of(Interop interop)
{
    switch (interop)
    {
        case Interop::on:
            return gpu::SharingWish::on;
        case Interop::off:
            return gpu::SharingWish::off;
        case Interop::automatic:
            break;
    }
    return gpu::SharingWish::automatic;
}

WayToGl way_of(const gpu::Sharing& sharing)
{
    return {gpu::describe(sharing), sharing.shared, sharing.because};
}

template <class Memory>
Engine on(std::unique_ptr<Memory> memory, WayToGl way, const World& world, const gpu::CudaOptions& options)
{
    Engine engine;
    engine.backend = gpu::make_cuda_backend(world, memory->on_device(), options);
    engine.memory = std::move(memory);
    engine.way = std::move(way);
    return engine;
}

}  // namespace

CudaSupport cuda_support()
{
    const gpu::Devices found = gpu::find_devices();
    CudaSupport support;
    support.built = true;
    support.none_because = found.none_because;
    support.versions = fmt::format("runtime {}, driver {}", version_text(found.runtime_version),
                                   version_text(found.driver_version));
    for (const gpu::DeviceInfo& d : found.list)
        support.devices.push_back(fmt::format("{} (compute {}.{}, {:.0f} GB, {} multiprocessors)", d.name,
                                              d.compute_major, d.compute_minor,
                                              static_cast<double>(d.memory_bytes) * 1e-9, d.multiprocessors));
    return support;
}

Engine make_cuda_engine(const World& world, const RunOptions& options, std::uint32_t reorder_every_steps,
                        Drawing drawing)
{
    const gpu::CudaOptions cuda{options.cuda_graph.value_or(gpu::CudaOptions{}.graph == gpu::StepGraph::on)
                                    ? gpu::StepGraph::on
                                    : gpu::StepGraph::off,
                                reorder_every_steps};
    if (drawing == Drawing::off)
        return on(std::make_unique<UndrawnMemory>(world.capacity),
                  {"device memory", false, "nothing is drawn"}, world, cuda);
    const gpu::SharingWish wish = wish_of(options.interop);
    gpu::Sharing sharing = gpu::find_sharing(wish);
    auto memory = gpu::make_drawn_memory(world.capacity, wish, sharing);
    return on(std::make_unique<DrawnMemory>(std::move(memory), sharing.shared), way_of(sharing), world, cuda);
}

PoissonSolverMaker cuda_poisson_solver()
{
    return [](const PoissonProblem& problem) { return gpu::make_poisson_solver(problem); };
}

std::unique_ptr<gl::Context> make_drawing_context()
{
    return gpu::make_context_beside_cuda();
}

WayToGl cuda_way_to_gl()
{
    return way_of(gpu::find_sharing(gpu::SharingWish::automatic));
}

}  // namespace spindrift::app
