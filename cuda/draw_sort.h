// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/backend.h"
#include "cuda/buffer.h"

namespace spindrift::gpu
{

/// Sorts draw lists by depth key; equal keys keep their order.
class DrawSort
{
  public:
    explicit DrawSort(std::size_t capacity);

    static std::vector<std::string> names() { return {"none", "radix"}; }
    /// Throws Error for a strategy or key width that there is not.
    static void check_settings(const SortSettings& settings);

    /// Queues the sort of n pairs and returns which of the two arrays they will be in.
    std::uint64_t* operator()(StreamRef stream, const SortSettings& settings, const DrawListView& list,
                              std::size_t n) const;

  private:
    DeviceBuffer<unsigned char> working_;
};

}  // namespace spindrift::gpu
