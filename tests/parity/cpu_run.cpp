// SPDX-License-Identifier: MIT
#include "cpu/cpu_backend.h"
#include "tests/parity/backends.h"

namespace spindrift::parity
{

namespace
{

class CpuRun final : public BackendRun
{
  public:
    CpuRun(const World& world, const cpu::CpuOptions& options)
        : memory_(world.capacity),
          backend_(cpu::make_cpu_backend(world, memory_.flakes(), memory_.draw_list(), options))
    {
    }
    Backend& backend() override { return *backend_; }
    std::vector<std::uint64_t> pairs(const DrawList& list) override
    {
        const std::uint64_t* from = list.in_scratch ? memory_.draw_list().scratch : memory_.draw_list().pairs;
        return {from, from + list.count};
    }
    std::vector<std::uint32_t> ids() override
    {
        const std::uint32_t* id = memory_.flakes().id;
        return {id, id + backend_->slots_used()};
    }
    void put(float* FlakeView::*array, std::size_t slot, float value) override
    {
        (memory_.flakes().*array)[slot] = value;
    }

  private:
    cpu::HostFlakes memory_;
    std::unique_ptr<Backend> backend_;
};

}  // namespace

std::unique_ptr<BackendRun> make_oracle(const World& world)
{
    return std::make_unique<CpuRun>(world, cpu::CpuOptions{1, cpu::Simd::scalar, 0});
}

std::unique_ptr<BackendRun> make_cpu_run(const World& world, int threads, std::uint32_t reorder_every_steps)
{
    return std::make_unique<CpuRun>(world,
                                    cpu::CpuOptions{threads, cpu::Simd::automatic, reorder_every_steps});
}

}  // namespace spindrift::parity
