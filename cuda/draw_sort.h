// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/backend.h"
#include "core/kept_order.h"
#include "cuda/sort/strategy.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

/// Sorts draw lists by the strategy that is asked for; its working memory is made when it is first asked for.
class DrawSort
{
  public:
    explicit DrawSort(std::size_t capacity) : capacity_(capacity) {}

    /// Throws Error, with the names of the table, if it has not got the one that is asked for.
    static const SortStrategy& strategy(const SortSettings& settings);
    /// Of the keys to make. Throws Error for a width that there is not.
    static int key_bits(const SortSettings& settings, const SortStrategy& strategy);

    /// Queues the sort of list.count pairs, which `view` sees, and sets where they will be.
    void operator()(StreamRef stream, const SortStrategy& strategy, const SortSettings& settings,
                    const View& view, const DrawListView& at, DrawList& list);

    /// DeviceSort::ranks of the sort that ran last; null at first.
    std::uint32_t* ranks() const { return sort_ ? sort_->ranks() : nullptr; }
    /// From now on slots stand for flakes that nobody followed: sorts over frames begin anew.
    void forget_order() { kept_order_.forget(); }

  private:
    std::size_t capacity_;
    std::string_view made_;  ///< name of the strategy that `sort_` is
    std::unique_ptr<DeviceSort> sort_;
    KeptOrder kept_order_;
};

}  // namespace spindrift::gpu
