// SPDX-License-Identifier: MIT
#include "cpu/draw_list.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "cpu/chunks.h"
#include "cpu/huge_pages.h"
#include "cpu/parallel.h"

namespace spindrift::cpu
{

namespace
{

int key_bits(const SortSettings& settings, const SortStrategy& strategy)
{
    const int bits = settings.depth_bits;
    if (bits != 32 && bits != 24 && bits != 16)
        throw Error(fmt::format("depth_bits = {} is no depth key; use 32, 24 or 16", bits));
    return strategy.sort == nullptr ? bits : std::min(bits, strategy.max_key_bits);
}

}  // namespace

DrawListMaker::DrawListMaker(const DrawListView& view, std::size_t capacity)
    : view_(view), capacity_(capacity), starts_(chunk_count(capacity) + 1)
{
    for (std::uint64_t* array : {view.pairs, view.scratch})
        ask_for_huge_pages(array, capacity * sizeof(std::uint64_t));
}

const SortStrategy& DrawListMaker::strategy(const SortSettings& settings)
{
    if (const SortStrategy* found = find_sort_strategy(settings.strategy)) return *found;
    std::string names;
    for (const SortStrategy& s : sort_strategies())
        names += (names.empty() ? "" : ", ") + std::string(s.name);
    throw Error(fmt::format("sort = \"{}\" is no sort of the CPU backend; use auto or one of {}",
                            settings.strategy, names));
}

DrawList DrawListMaker::fill(const KernelTable& kernels, const FlakeView& flakes, std::size_t used,
                             const View& view, const SortSettings& settings, const SortStrategy& strategy)
{
    const Frustum f = frustum(view, key_bits(settings, strategy));
    const std::size_t chunks = chunk_count(used);
    std::size_t* const starts = starts_.data();
    // each chunk lists into its own stretch of the scratch, then the stretches are put together
    parallel_for_each_index(chunks,
                            [&](std::size_t c)
                            {
                                const Chunk chunk(c, used);
                                starts[c + 1] = kernels.list_visible(f, flakes, chunk.first, chunk.last,
                                                                     view_.scratch + chunk.first);
                            });
    starts[0] = 0;
    for (std::size_t c = 0; c < chunks; ++c) starts[c + 1] += starts[c];
    parallel_for_each_index(chunks,
                            [&](std::size_t c) {
                                std::copy_n(view_.scratch + Chunk(c, used).first, starts[c + 1] - starts[c],
                                            view_.pairs + starts[c]);
                            });
    DrawList list;
    list.count = starts[chunks];
    return list;
}

const std::uint64_t* DrawListMaker::sort_over_frames(const SortJob& job, Network network, int passes,
                                                     const View& view)
{
    if (passes < 1) throw Error(fmt::format("passes per frame = {} sorts nothing; use 1 or more", passes));
    if (!pass_sorter_ || pass_sorter_->network() != network)
    {
        pass_sorter_.emplace(network, capacity_);
        kept_order_.forget();
    }
    return pass_sorter_->sort(job, passes, kept_order_.next(view));
}

void DrawListMaker::sort(const SortStrategy& strategy, const SortSettings& settings, const View& view,
                         DrawList& list)
{
    const SortJob job{view_.pairs, view_.scratch, list.count, key_bits(settings, strategy)};
    if (strategy.network)
        list.in_scratch =
            sort_over_frames(job, *strategy.network, settings.passes_per_frame, view) == job.scratch;
    else
        kept_order_.forget();
    if (strategy.sort != nullptr) list.in_scratch = strategy.sort(job) == job.scratch;
    list.sorted = strategy.network || strategy.sort != nullptr;
}

}  // namespace spindrift::cpu
