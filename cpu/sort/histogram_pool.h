// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace spindrift::cpu
{

/// Memory for the counters of one sort, borrowed from a pool that keeps it, so that a sort allocates only
/// when it needs more than any sort before it. Sorts that run at the same time get different memory. Not
/// cleared.
class HistogramLease
{
  public:
    explicit HistogramLease(std::size_t counters);
    ~HistogramLease();
    HistogramLease(const HistogramLease&) = delete;
    HistogramLease& operator=(const HistogramLease&) = delete;

    std::uint32_t* counters() const;  ///< aligned to 64 bytes

    struct Block;

  private:
    std::unique_ptr<Block> block_;
};

}  // namespace spindrift::cpu
