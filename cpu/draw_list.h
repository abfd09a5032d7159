// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/backend.h"
#include "core/kept_order.h"
#include "core/view.h"
#include "cpu/kernels.h"
#include "cpu/sort/passes.h"
#include "cpu/sort/strategy.h"

namespace spindrift::cpu
{

/// Lists the visible flakes with their depth keys and sorts them.
class DrawListMaker
{
  public:
    DrawListMaker(const DrawListView& view, std::size_t capacity);

    /// Throws Error, with the names of the table, if it has not got the one that is asked for.
    static const SortStrategy& strategy(const SortSettings& settings);

    /// Fills pairs in slot order. Parallel; the result does not depend on the threads.
    DrawList fill(const KernelTable& kernels, const FlakeView& flakes, std::size_t used, const View& view,
                  const SortSettings& settings, const SortStrategy& strategy);

    /// `view`: the one that the list was filled for.
    void sort(const SortStrategy& strategy, const SortSettings& settings, const View& view, DrawList& list);

    /// By slot: places in the order that a sort over frames keeps. Whoever gives flakes other slots takes
    /// these along. Null if no such sort has run.
    std::uint32_t* ranks() { return pass_sorter_ ? pass_sorter_->ranks() : nullptr; }
    /// From now on slots stand for flakes that nobody followed: sorts over frames begin anew.
    void forget_order() { kept_order_.forget(); }

  private:
    const std::uint64_t* sort_over_frames(const SortJob& job, Network network, int passes, const View& view);

    DrawListView view_;
    std::size_t capacity_;
    std::optional<PassSorter> pass_sorter_;  ///< once it is asked for
    KeptOrder kept_order_;
    std::vector<std::size_t> starts_;  ///< where each chunk's pairs begin
};

}  // namespace spindrift::cpu
