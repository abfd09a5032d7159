// SPDX-License-Identifier: MIT
#include <utility>

#include "app/engine.h"
#include "app/machine.h"
#include "cpu/cpu_backend.h"

namespace spindrift::app
{

Engine make_cpu_engine(const World& world, const RunOptions& options, std::uint32_t reorder_every_steps,
                       Drawing drawing)
{
    Engine engine;
    std::unique_ptr<HostFlakeMemory> memory;
    if (drawing == Drawing::off)
    {
        engine.way = {"host memory", false, "nothing is drawn"};
        memory = make_host_memory(world.capacity);
    }
    else if (options.interop == Interop::off)
    {
        engine.way = {"host memory, copied to GL for each frame", false, "asked for with --interop off"};
        memory = make_staged_memory(world.capacity);
    }
    else
    {
        engine.way = {"GL's buffers, which the simulation writes in place", true,
                      "OpenGL 4.5 maps its buffers for the processor persistently"};
        memory = make_shared_memory(world.capacity);
    }
    cpu::CpuOptions cpu = cpu_options(options);
    cpu.reorder_every_steps = reorder_every_steps;
    engine.backend = cpu::make_cpu_backend(world, memory->flakes(), memory->draw_list(), cpu);
    engine.memory = std::move(memory);
    return engine;
}

}  // namespace spindrift::app
