// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <tbb/task_scheduler_observer.h>

namespace spindrift::bench
{

/// While it lives, each TBB worker stays on a core of its own, so that a busy machine does not put two
/// threads of one measurement on the same core. The calling thread stays free, and with it threads that
/// libraries start.
class PinnedWorkers : private tbb::task_scheduler_observer
{
  public:
    PinnedWorkers();
    ~PinnedWorkers() override;
    PinnedWorkers(const PinnedWorkers&) = delete;
    PinnedWorkers& operator=(const PinnedWorkers&) = delete;

  private:
    void on_scheduler_entry(bool is_worker) override;

    std::vector<int> cores_;  // that this process may use
};

}  // namespace spindrift::bench
