// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "app/flake_memory.h"
#include "app/options.h"
#include "app/stage_log.h"
#include "core/backend.h"
#include "core/world.h"

namespace spindrift::app
{

/// The flakes of a run: their memory, the backend that moves them, and a note of every stage's time.
class Simulator
{
  public:
    /// `world` must outlive it. Throws Error if the machine cannot do what was asked.
    Simulator(const World& world, std::unique_ptr<FlakeMemory> memory, const cpu::CpuOptions& options,
              StageLog& log);

    /// Steps until `steps` are complete, or `stop` answers true; `each` is called after each step. True:
    /// arrived.
    bool advance_to(std::uint64_t steps, const std::function<bool()>& stop,
                    const std::function<void()>& each = {});

    /// Culls and sorts for a view, and hands the flakes over to GL.
    DrawList prepare(const View& view, const SortSettings& sort);

    Backend& backend() { return *backend_; }
    const FlakeMemory& memory() const { return *memory_; }
    const cpu::CpuOptions& options() const { return options_; }

  private:
    std::unique_ptr<FlakeMemory> memory_;
    cpu::CpuOptions options_;
    std::unique_ptr<Backend> backend_;
    StageLog& log_;
};

}  // namespace spindrift::app
