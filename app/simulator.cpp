// SPDX-License-Identifier: MIT
#include "app/simulator.h"

#include <utility>

namespace spindrift::app
{

Simulator::Simulator(const World& world, std::unique_ptr<FlakeMemory> memory, const cpu::CpuOptions& options,
                     StageLog& log)
    : memory_(std::move(memory)),
      options_(options),
      backend_(cpu::make_cpu_backend(world, memory_->flakes(), memory_->draw_list(), options)),
      log_(log)
{
}

bool Simulator::advance_to(std::uint64_t steps, const std::function<bool()>& stop,
                           const std::function<void()>& each)
{
    while (backend_->step_number() < steps)
    {
        if (stop()) return false;
        {
            const StageTimer timer(log_, "step");
            backend_->step();
        }
        const StageTimes times = backend_->times();
        log_.add("emit", times.emit);
        log_.add("advect", times.advect);
        log_.add("compact", times.compact);
        if (each) each();
    }
    return true;
}

DrawList Simulator::prepare(const View& view, const SortSettings& sort)
{
    const DrawList list = backend_->prepare(view, sort);
    const StageTimes times = backend_->times();
    log_.add("cull", times.cull);
    if (list.sorted) log_.add("sort", times.sort);
    const StageTimer timer(log_, "upload");
    memory_->hand_over(backend_->slots_used(), list);
    return list;
}

}  // namespace spindrift::app
