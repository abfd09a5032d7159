// SPDX-License-Identifier: MIT
#include "app/sort_choice.h"
#include "cuda/sort/strategy.h"

namespace spindrift::app
{

std::vector<SortName> cuda_sorts()
{
    std::vector<SortName> sorts;
    for (const gpu::SortStrategy& strategy : gpu::sort_strategies())
        sorts.push_back({strategy.name, strategy.about});
    return sorts;
}

std::optional<std::string> find_cuda_sort(const std::string& asked)
{
    const gpu::SortStrategy* const found = gpu::find_sort_strategy(asked);
    return found == nullptr ? std::nullopt : std::optional(std::string(found->name));
}

}  // namespace spindrift::app
