// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "core/backend.h"
#include "core/view.h"
#include "cpu/kernels.h"
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

    void sort(const SortStrategy& strategy, const SortSettings& settings, DrawList& list) const;

  private:
    DrawListView view_;
    std::vector<std::size_t> starts_;  ///< where each chunk's pairs begin
};

}  // namespace spindrift::cpu
