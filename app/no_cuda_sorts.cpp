// SPDX-License-Identifier: MIT
#include "app/sort_choice.h"

namespace spindrift::app
{

std::vector<SortName> cuda_sorts()
{
    return {};
}

std::optional<std::string> find_cuda_sort(const std::string&)
{
    return std::nullopt;
}

}  // namespace spindrift::app
