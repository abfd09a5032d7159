// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace spindrift::cpu
{

namespace detail
{

// Debian's libtbb is not instrumented, so ThreadSanitizer does not see that its fork and join order memory. These say so.
inline void tsan_release([[maybe_unused]] void* at)
{
#if defined(__SANITIZE_THREAD__)
    __tsan_release(at);
#endif
}
inline void tsan_acquire([[maybe_unused]] void* at)
{
#if defined(__SANITIZE_THREAD__)
    __tsan_acquire(at);
#endif
}

}  // namespace detail

/// Calls body(i) for i in [0, n) on the threads of the current TBB arena and waits. What body writes must not depend on
/// which thread runs it. The only way in which cpu/ goes parallel.
template <class Body>
void parallel_for_each_index(std::size_t n, const Body& body)
{
    if (n == 0) return;
    if (n == 1)
    {
        body(std::size_t{0});
        return;
    }
    char fork = 0;
    char join = 0;
    detail::tsan_release(&fork);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, n, 1),
        [&](const tbb::blocked_range<std::size_t>& range)
        {
            detail::tsan_acquire(&fork);
            for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
            detail::tsan_release(&join);
        },
        tbb::simple_partitioner{});
    detail::tsan_acquire(&join);
}

}  // namespace spindrift::cpu
