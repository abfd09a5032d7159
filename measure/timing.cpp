// SPDX-License-Identifier: MIT
#include "measure/timing.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include <tbb/task_arena.h>

#include "cpu/parallel.h"

namespace spindrift::measure
{

double quantile(std::vector<double> samples, double q)
{
    if (samples.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto at =
        samples.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(samples.size() - 1));
    std::nth_element(samples.begin(), at, samples.end());
    return *at;
}

void parallel_copy(void* to, const void* from, std::size_t bytes)
{
    constexpr std::size_t kLine = 64;
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    const std::size_t share = (bytes / threads / kLine + 1) * kLine;
    cpu::parallel_for_each_index(threads,
                                 [&](std::size_t thread)
                                 {
                                     const std::size_t begin = std::min(bytes, thread * share);
                                     const std::size_t end = std::min(bytes, begin + share);
                                     if (begin == end) return;  // of nothing there may be no address
                                     std::memcpy(static_cast<char*>(to) + begin,
                                                 static_cast<const char*>(from) + begin, end - begin);
                                 });
}

}  // namespace spindrift::measure
