// SPDX-License-Identifier: MIT
#pragma once

#include <tbb/task_scheduler_observer.h>

namespace spindrift::measure
{

/// While it lives, each thread of TBB that works stays on a core of its own, the calling thread on the first,
/// so that a busy machine does not put two threads of one measurement on the same core.
class PinnedThreads : private tbb::task_scheduler_observer
{
  public:
    PinnedThreads();
    ~PinnedThreads() override;
    PinnedThreads(const PinnedThreads&) = delete;
    PinnedThreads& operator=(const PinnedThreads&) = delete;

  private:
    void on_scheduler_entry(bool is_worker) override;
    void on_scheduler_exit(bool is_worker) override;
};

/// While it lives, the calling thread and threads that it starts may use every core that the process had at
/// first: for libraries that start their own threads.
class AnyCore
{
  public:
    AnyCore();
    ~AnyCore();
    AnyCore(const AnyCore&) = delete;
    AnyCore& operator=(const AnyCore&) = delete;
};

}  // namespace spindrift::measure
