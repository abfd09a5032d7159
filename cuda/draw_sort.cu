// SPDX-License-Identifier: MIT
#include "cuda/draw_sort.h"

#include <cub/device/device_radix_sort.cuh>

#include "core/error.h"
#include "cuda/check.h"

namespace spindrift::gpu
{

namespace
{

constexpr int kKeyShift = 32;

cudaError_t sort_pairs(void* memory, std::size_t& bytes, cub::DoubleBuffer<std::uint64_t>& pairs,
                       std::size_t n, int key_bits, cudaStream_t stream)
{
    return cub::DeviceRadixSort::SortKeys(memory, bytes, pairs, static_cast<std::uint32_t>(n), kKeyShift,
                                          kKeyShift + key_bits, stream);
}

std::size_t working_bytes(std::size_t capacity)
{
    std::size_t bytes = 0;
    cub::DoubleBuffer<std::uint64_t> pairs;
    check(sort_pairs(nullptr, bytes, pairs, capacity, 32, nullptr), "cub::DeviceRadixSort");
    return bytes;
}

}  // namespace

DrawSort::DrawSort(std::size_t capacity) : working_(capacity > 0 ? working_bytes(capacity) : 0) {}

void DrawSort::check_settings(const SortSettings& settings)
{
    if (settings.depth_bits != 32 && settings.depth_bits != 24 && settings.depth_bits != 16)
        throw Error("depth_bits = " + std::to_string(settings.depth_bits) +
                    " is no depth key; use 32, 24 or 16");
    if (settings.strategy != "none" && settings.strategy != "radix")
        throw Error("sort = \"" + settings.strategy +
                    "\" is not known to the CUDA backend; use one of none, radix");
}

std::uint64_t* DrawSort::operator()(StreamRef stream, const SortSettings& settings, const DrawListView& list,
                                    std::size_t n) const
{
    if (n == 0) return list.pairs;
    cub::DoubleBuffer<std::uint64_t> pairs(list.pairs, list.scratch);
    std::size_t bytes = working_.size();
    check(sort_pairs(working_.data(), bytes, pairs, n, settings.depth_bits, stream.get()),
          "cub::DeviceRadixSort");
    return pairs.Current();
}

}  // namespace spindrift::gpu
