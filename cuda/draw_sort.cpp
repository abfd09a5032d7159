// SPDX-License-Identifier: MIT
#include "cuda/draw_sort.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"

namespace spindrift::gpu
{

const SortStrategy& DrawSort::strategy(const SortSettings& settings)
{
    if (const SortStrategy* found = find_sort_strategy(settings.strategy)) return *found;
    std::string names;
    for (const SortStrategy& s : sort_strategies())
        names += (names.empty() ? "" : ", ") + std::string(s.name);
    throw Error(fmt::format("sort = \"{}\" is no sort of the CUDA backend; use auto or one of {}",
                            settings.strategy, names));
}

int DrawSort::key_bits(const SortSettings& settings, const SortStrategy& strategy)
{
    const int bits = settings.depth_bits;
    if (bits != 32 && bits != 24 && bits != 16)
        throw Error(fmt::format("depth_bits = {} is no depth key; use 32, 24 or 16", bits));
    return std::min(bits, strategy.max_key_bits);
}

void DrawSort::operator()(StreamRef stream, const SortStrategy& strategy, const SortSettings& settings,
                          const View& view, const DrawListView& at, DrawList& list)
{
    if (!strategy.network) kept_order_.forget();
    if (strategy.make == nullptr) return;
    if (made_ != strategy.name)
    {
        sort_ = strategy.make(capacity_);
        made_ = strategy.name;
        kept_order_.forget();
    }
    SortJob job{at.pairs, at.scratch, list.count, key_bits(settings, strategy)};
    if (strategy.network)
    {
        if (settings.passes_per_frame < 1)
            throw Error(
                fmt::format("passes per frame = {} sorts nothing; use 1 or more", settings.passes_per_frame));
        job.passes = settings.passes_per_frame;
        job.start = kept_order_.next(view);
    }
    list.in_scratch = sort_->sort(stream, job) == at.scratch;
    list.sorted = true;
}

}  // namespace spindrift::gpu
