// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "measure/sort_contender.h"

namespace spindrift::measure
{

// In a build without CUDA, or on a machine without a device, there are none.

std::vector<SortTraits> cuda_sorts();
std::vector<std::unique_ptr<SortContender>> make_cuda_contenders(std::vector<SortTraits> sorts,
                                                                 std::size_t pairs, std::size_t slots);

}  // namespace spindrift::measure
