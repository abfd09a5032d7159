// SPDX-License-Identifier: MIT
#include "measure/sort_contender.h"

#include <algorithm>

#include "measure/cpu_sorts.h"
#include "measure/cuda_sorts.h"

namespace spindrift::measure
{

std::vector<SortTraits> list_sorts(const WantedSorts& wanted)
{
    std::vector<SortTraits> all;
    if (wanted.cpu) all = cpu_sorts();
    if (!wanted.unsorted)
        std::erase_if(all, [](const SortTraits& traits) { return traits.strategy == "none"; });
    if (wanted.cuda)
        for (SortTraits& traits : cuda_sorts()) all.push_back(std::move(traits));
    if (!wanted.strategies.empty())
        std::erase_if(all, [&](const SortTraits& traits)
                      { return std::ranges::count(wanted.strategies, traits.strategy) == 0; });
    return all;
}

std::vector<std::uint32_t> moved_ranks(std::span<const std::uint32_t> ranks,
                                       std::span<const std::uint32_t> sources)
{
    std::vector<std::uint32_t> moved(ranks.size(), kNoRank);
    for (std::size_t i = 0; i < sources.size(); ++i)
        if (sources[i] != kNoRank) moved[i] = ranks[sources[i]];
    return moved;
}

std::vector<std::unique_ptr<SortContender>> make_contenders(const WantedSorts& wanted, std::size_t pairs,
                                                            std::size_t slots)
{
    std::vector<SortTraits> of_cpu, of_cuda;
    for (SortTraits& traits : list_sorts(wanted))
        (traits.backend == "cpu" ? of_cpu : of_cuda).push_back(std::move(traits));
    auto all = make_cpu_contenders(std::move(of_cpu), pairs, slots);
    for (auto& contender : make_cuda_contenders(std::move(of_cuda), pairs, slots))
        all.push_back(std::move(contender));
    return all;
}

}  // namespace spindrift::measure
