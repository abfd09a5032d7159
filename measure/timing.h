// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

namespace spindrift::measure
{

/// Milliseconds that a call takes.
template <class Call>
double time_ms(const Call& call)
{
    const auto start = std::chrono::steady_clock::now();
    call();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// The value below which the share `q` of the samples lies; 0.5: the median. NaN without samples.
double quantile(std::vector<double> samples, double q);

/// Copies on all threads of the current arena: the floor that a stage which moves `bytes` is held against.
void parallel_copy(void* to, const void* from, std::size_t bytes);

}  // namespace spindrift::measure
