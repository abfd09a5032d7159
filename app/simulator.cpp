// SPDX-License-Identifier: MIT
#include "app/simulator.h"

#include <cmath>
#include <utility>

namespace spindrift::app
{

namespace
{

void add(StageLog& log, const char* stage, double ms)
{
    if (!std::isnan(ms)) log.add(stage, ms);
}

}  // namespace

Simulator::Simulator(std::unique_ptr<FlakeMemory> memory, std::unique_ptr<Backend> backend, StageLog& log)
    : memory_(std::move(memory)), backend_(std::move(backend)), log_(log)
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
        add(log_, "emit", times.emit);
        add(log_, "advect", times.advect);
        add(log_, "compact", times.compact);
        add(log_, "step on the device", times.step);
        if (each) each();
    }
    return true;
}

DrawList Simulator::prepare(const View& view, const SortSettings& sort)
{
    DrawList list = backend_->prepare(view, sort);
    const StageTimes times = backend_->times();
    add(log_, "cull", times.cull);
    if (list.sorted) add(log_, "sort", times.sort);
    const StageTimer timer(log_, "upload");
    memory_->hand_over(backend_->slots_used(), list);
    backend_->close(list);
    list.slots = memory_->readable(list);
    return list;
}

FlakeCounts Simulator::exact_counts()
{
    backend_->finish();
    return backend_->counts();
}

}  // namespace spindrift::app
