// SPDX-License-Identifier: MIT
#include "bench/pinned_workers.h"

#include <sched.h>

#include <tbb/task_arena.h>

namespace spindrift::bench
{

PinnedWorkers::PinnedWorkers()
{
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0)
        for (int core = 0; core < CPU_SETSIZE; ++core)
            if (CPU_ISSET(core, &allowed)) cores_.push_back(core);
    observe(true);
}

PinnedWorkers::~PinnedWorkers()
{
    observe(false);
}

void PinnedWorkers::on_scheduler_entry(bool is_worker)
{
    if (!is_worker || cores_.empty()) return;
    const auto slot = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
    cpu_set_t own;
    CPU_ZERO(&own);
    CPU_SET(cores_[slot % cores_.size()], &own);
    sched_setaffinity(0, sizeof own, &own);  // a refusal only makes the figures noisier
}

}  // namespace spindrift::bench
