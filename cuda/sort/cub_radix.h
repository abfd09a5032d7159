// SPDX-License-Identifier: MIT
#pragma once

#include "cuda/buffer.h"
#include "cuda/sort/strategy.h"

namespace spindrift::gpu
{

/// CUB's radix sort of whole pairs by their key bits alone; stable, so equal keys keep ascending slots.
class CubRadix final : public DeviceSort
{
  public:
    explicit CubRadix(std::size_t capacity);
    std::uint64_t* sort(StreamRef stream, const SortJob& job) override;

  private:
    DeviceBuffer<unsigned char> working_;
};

}  // namespace spindrift::gpu
