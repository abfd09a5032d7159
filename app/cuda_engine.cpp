// SPDX-License-Identifier: MIT
#include <utility>

#include <fmt/format.h>

#include "app/engine.h"
#include "core/error.h"
#include "cuda/cuda_backend.h"
#include "cuda/device.h"
#include "cuda/flake_memory.h"
#include "gl/flake_buffers.h"

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

/// Flakes on the device whose newest state is copied into GL's buffers for each frame.
class CopiedFlakes final : public gpu::FlakeMemory
{
  public:
    explicit CopiedFlakes(std::size_t capacity) : device_(capacity), buffers_(capacity) {}
    const gl::FlakeBuffers& buffers() const { return buffers_; }
    std::size_t capacity() const override { return device_.capacity(); }
    std::size_t bytes() const override { return device_.bytes() + buffers_.bytes(); }
    gpu::FlakeAddresses map(gpu::StreamRef stream) override { return at_ = device_.map(stream); }
    void unmap(gpu::StreamRef stream) override { stream.wait(); }

    void hand_over(gpu::StreamRef stream, std::size_t used, const DrawList& list) override
    {
        const auto from = flake_words(at_.flakes);
        const auto to = flake_words(buffers_.flakes());
        for (std::size_t a = 0; used > 0 && a < from.size(); ++a)
            gpu::copy_to_host(stream, to[a], from[a], used);
        const auto pairs = list.in_scratch ? &DrawListView::scratch : &DrawListView::pairs;
        if (list.count > 0)
            gpu::copy_to_host(stream, buffers_.draw_list().*pairs, at_.draw_list.*pairs, list.count);
    }

  private:
    gpu::DeviceFlakes device_;
    gl::FlakeBuffers buffers_;
    gpu::FlakeAddresses at_;
};

class CopiedMemory final : public FlakeMemory
{
  public:
    explicit CopiedMemory(std::size_t capacity) : copied_(capacity) {}
    gpu::FlakeMemory& on_device() { return copied_; }
    std::size_t bytes() const override { return copied_.bytes(); }
    const gl::FlakeBuffers* drawn_from() const override { return &copied_.buffers(); }
    void hand_over(std::size_t, const DrawList&) override {}  // Backend::close does

  private:
    CopiedFlakes copied_;
};

template <class Memory>
Engine on(std::unique_ptr<Memory> memory, std::string about, const World& world,
          const gpu::CudaOptions& options)
{
    Engine engine;
    engine.backend = gpu::make_cuda_backend(world, memory->on_device(), options);
    engine.memory = std::move(memory);
    engine.about_memory = std::move(about);
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
        return on(std::make_unique<UndrawnMemory>(world.capacity), "device memory (nothing is drawn)", world,
                  cuda);
    if (options.interop == Interop::on)
        throw Error("--interop on: the CUDA backend copies the flakes to GL; use --interop auto or off");
    return on(std::make_unique<CopiedMemory>(world.capacity), "device memory, copied to GL for each frame",
              world, cuda);
}

}  // namespace spindrift::app
