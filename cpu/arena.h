// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace spindrift::cpu
{

/// As many threads as were asked for: TBB's arena, and the leave to start more threads than there are cores.
class Arena
{
  public:
    /// 0: one per core. Throws Error for a negative number.
    explicit Arena(int threads);

    int threads() const { return threads_; }
    template <class Body>
    void execute(const Body& body) const
    {
        arena_.execute(body);
    }

  private:
    int threads_;
    std::optional<tbb::global_control> more_threads_;
    mutable tbb::task_arena arena_;
};

}  // namespace spindrift::cpu
