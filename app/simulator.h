// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "app/flake_memory.h"
#include "app/stage_log.h"
#include "core/backend.h"

namespace spindrift::app
{

/// The flakes of a run: their memory, the backend that moves them, and a note of every stage's time.
class Simulator
{
  public:
    Simulator(std::unique_ptr<FlakeMemory> memory, std::unique_ptr<Backend> backend, StageLog& log);

    /// Steps until `steps` are complete, or `stop` answers true; `each` is called after each step. True:
    /// arrived.
    bool advance_to(std::uint64_t steps, const std::function<bool()>& stop,
                    const std::function<void()>& each = {});

    /// Culls and sorts for a view, and hands the flakes over to GL.
    DrawList prepare(const View& view, const SortSettings& sort);

    /// Counts of the steps that were made so far, not those that happen to be known.
    FlakeCounts exact_counts();

    Backend& backend() { return *backend_; }
    const FlakeMemory& memory() const { return *memory_; }

  private:
    std::unique_ptr<FlakeMemory> memory_;
    std::unique_ptr<Backend> backend_;
    StageLog& log_;
};

}  // namespace spindrift::app
