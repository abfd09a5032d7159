// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "core/kept_order.h"
#include "core/sort_network.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

/// One sort of (depth key << 32 | slot) pairs in device memory, ascending.
struct SortJob
{
    std::uint64_t* pairs;    ///< n elements, in ascending slot order
    std::uint64_t* scratch;  ///< n elements
    std::size_t n;
    int key_bits;    ///< keys are < 2^key_bits: 32, 24 or 16
    int passes = 0;  ///< sorts over frames: steps of this frame, and from what they begin
    SortStart start = SortStart::exact;
};

/// A sort with the working memory that it needs, all allocated when it is made. Calls must be on one stream,
/// or wait for each other.
class DeviceSort
{
  public:
    virtual ~DeviceSort() = default;
    /// Queues the work and returns where the pairs will be: job.pairs or job.scratch. Neither allocates nor
    /// waits. Throws Error with what CUDA returned.
    virtual std::uint64_t* sort(StreamRef stream, const SortJob& job) = 0;
    /// By slot, on the device: places in the order that a sort over frames keeps, or kNoRank. Whoever gives
    /// flakes other slots takes these along. Null for sorts that keep none.
    virtual std::uint32_t* ranks() const { return nullptr; }
};

/// A row of the table. Every exact strategy gives the permutation that the CPU's give.
struct SortStrategy
{
    std::string_view name;
    std::string_view about;  ///< one line for --help
    /// For at most `capacity` pairs with slots below it. Null for "none". Throws Error without room for it.
    std::unique_ptr<DeviceSort> (*make)(std::size_t capacity);
    int max_key_bits;  ///< most key bits that it can use: the key maker narrows the keys to it
    /// What its kernels read and write, in bytes a pair; 0: not known.
    double (*bytes_per_pair)(std::size_t n, int key_bits, int passes);
    /// Set: it sorts over frames and is not exact.
    std::optional<Network> network = {};
};

/// The table; order is the order of --help and of the key that steps through strategies.
std::span<const SortStrategy> sort_strategies();

/// Null if there is none of that name. "auto" is cub-radix, "passes" is short for "bitonic-passes".
const SortStrategy* find_sort_strategy(std::string_view name);

}  // namespace spindrift::gpu
