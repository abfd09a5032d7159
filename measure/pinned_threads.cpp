// SPDX-License-Identifier: MIT
#include "measure/pinned_threads.h"

#include <sched.h>

#include <vector>

#include <tbb/info.h>
#include <tbb/task_arena.h>

namespace spindrift::measure
{

namespace
{

// That the process may use when it starts to measure; a refused pin only makes the figures noisier.
const cpu_set_t& allowed_cores()
{
    static const cpu_set_t allowed = []
    {
        cpu_set_t set;
        CPU_ZERO(&set);
        sched_getaffinity(0, sizeof set, &set);
        return set;
    }();
    return allowed;
}

void pin_this_thread(int slot)
{
    std::vector<int> cores;
    for (int core = 0; core < CPU_SETSIZE; ++core)
        if (CPU_ISSET(core, &allowed_cores())) cores.push_back(core);
    if (cores.empty()) return;
    cpu_set_t own;
    CPU_ZERO(&own);
    CPU_SET(cores[static_cast<std::size_t>(slot) % cores.size()], &own);
    sched_setaffinity(0, sizeof own, &own);
}

void free_this_thread()
{
    sched_setaffinity(0, sizeof(cpu_set_t), &allowed_cores());
}

}  // namespace

PinnedThreads::PinnedThreads()
{
    allowed_cores();
    tbb::info::default_concurrency();  // TBB counts the cores that the first thread to ask may use, once
    pin_this_thread(0);
    observe(true);
}

PinnedThreads::~PinnedThreads()
{
    observe(false);
    free_this_thread();
}

void PinnedThreads::on_scheduler_entry(bool is_worker)
{
    if (is_worker) pin_this_thread(tbb::this_task_arena::current_thread_index());
}

void PinnedThreads::on_scheduler_exit(bool is_worker)
{
    if (is_worker) free_this_thread();
}

AnyCore::AnyCore()
{
    free_this_thread();
}

AnyCore::~AnyCore()
{
    pin_this_thread(0);
}

}  // namespace spindrift::measure
