// SPDX-License-Identifier: MIT
#include "cpu/arena.h"

#include <fmt/format.h>
#include <tbb/info.h>

#include "core/error.h"

namespace spindrift::cpu
{

namespace
{

int thread_count(int asked)
{
    if (asked < 0) throw Error(fmt::format("threads = {} is negative; use 0 (one per core) or more", asked));
    return asked == 0 ? tbb::info::default_concurrency() : asked;
}

/// TBB starts no more threads than there are cores unless told so.
std::optional<tbb::global_control> more_threads(int threads)
{
    if (threads <= tbb::info::default_concurrency()) return std::nullopt;
    return std::make_optional<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                   static_cast<std::size_t>(threads));
}

}  // namespace

Arena::Arena(int threads)
    : threads_(thread_count(threads)), more_threads_(more_threads(threads_)), arena_(threads_)
{
}

}  // namespace spindrift::cpu
