// SPDX-License-Identifier: MIT
#include "cuda/buffer.h"
#include "cuda/cuda_backend.h"
#include "cuda/device.h"
#include "tests/parity/backends.h"

namespace spindrift::parity
{

namespace
{

class CudaRun final : public BackendRun
{
  public:
    CudaRun(const World& world, const gpu::CudaOptions& options)
        : memory_(world.capacity), backend_(gpu::make_cuda_backend(world, memory_, options))
    {
    }
    Backend& backend() override { return *backend_; }
    std::vector<std::uint64_t> pairs(const DrawList& list) override
    {
        const DrawListView at = addresses().draw_list;
        return fetch(list.in_scratch ? at.scratch : at.pairs, list.count);
    }
    std::vector<std::uint32_t> ids() override
    {
        backend_->finish();
        return fetch(addresses().flakes.id, backend_->slots_used());
    }
    void put(float* FlakeView::*array, std::size_t slot, float value) override
    {
        backend_->finish();
        gpu::copy_to_device_now(addresses().flakes.*array + slot, &value, 1);
    }

  private:
    gpu::FlakeAddresses addresses() { return memory_.map(gpu::StreamRef(nullptr)); }
    template <class T>
    std::vector<T> fetch(const T* from, std::size_t n)
    {
        backend_->finish();
        std::vector<T> to(n);
        if (n > 0)
            gpu::check(cudaMemcpy(to.data(), from, n * sizeof(T), cudaMemcpyDeviceToHost), "cudaMemcpy");
        return to;
    }

    gpu::DeviceFlakes memory_;
    std::unique_ptr<Backend> backend_;
};

}  // namespace

std::vector<Variant> variants()
{
    const auto variant = [](const char* name, gpu::StepGraph graph, std::uint32_t reorder)
    {
        return Variant{name,
                       [=](const World& world) {
                           return std::make_unique<CudaRun>(world, gpu::CudaOptions{graph, reorder});
                       },
                       reorder};
    };
    return {variant("Graph", gpu::StepGraph::on, 0), variant("KernelByKernel", gpu::StepGraph::off, 0),
            variant("GraphReorderedEverySevenSteps", gpu::StepGraph::on, 7),
            variant("KernelByKernelReorderedEachStep", gpu::StepGraph::off, 1)};
}

std::string cannot_run_because()
{
    const gpu::Devices devices = gpu::find_devices();
    return devices.list.empty() ? "no CUDA device: " + devices.none_because : "";
}

}  // namespace spindrift::parity
