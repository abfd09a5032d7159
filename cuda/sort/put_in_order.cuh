// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace spindrift::gpu
{

/// One comparator of a network.
__device__ inline void put_in_order(std::uint64_t& lower, std::uint64_t& upper)
{
    const std::uint64_t a = lower, b = upper;
    if (b < a) lower = b, upper = a;
}

}  // namespace spindrift::gpu
