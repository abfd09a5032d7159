// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#if defined(__SANITIZE_THREAD__)
#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include <tbb/task_arena.h>
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#endif

namespace spindrift::cpu
{

namespace detail
{

#if defined(__SANITIZE_THREAD__)
// Debian's libtbb is not instrumented: ThreadSanitizer does not see that its fork and join order memory, and
// reports each task. So its builds run the same bodies on threads that it understands, as many as the arena
// has.
template <class Body>
void for_each_index(std::size_t n, const Body& body)
{
    std::atomic<std::size_t> next{0};
    const auto work = [&]
    {
        for (std::size_t i = next++; i < n; i = next++) body(i);
    };
    std::vector<std::jthread> helpers;
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    for (std::size_t helper = 1; helper < std::min(n, threads); ++helper) helpers.emplace_back(work);
    work();
}
#else
template <class Body>
void for_each_index(std::size_t n, const Body& body)
{
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, n, 1),
        [&](const tbb::blocked_range<std::size_t>& range)
        {
            for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
        },
        tbb::simple_partitioner{});
}
#endif

}  // namespace detail

/// Calls body(i) for i in [0, n) on the threads of the current TBB arena and waits. What body writes must not
/// depend on which thread runs it. The only way in which cpu/ goes parallel.
template <class Body>
void parallel_for_each_index(std::size_t n, const Body& body)
{
    if (n == 0) return;
    if (n == 1)
        body(std::size_t{0});
    else
        detail::for_each_index(n, body);
}

}  // namespace spindrift::cpu
