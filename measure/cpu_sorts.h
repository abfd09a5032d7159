// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "measure/sort_contender.h"

namespace spindrift::measure
{

std::vector<SortTraits> cpu_sorts();
std::vector<std::unique_ptr<SortContender>> make_cpu_contenders(std::vector<SortTraits> sorts,
                                                                std::size_t pairs, std::size_t slots);

}  // namespace spindrift::measure
