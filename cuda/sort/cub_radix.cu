// SPDX-License-Identifier: MIT
#include "cuda/sort/cub_radix.h"

#include <algorithm>

#include <cub/device/device_radix_sort.cuh>
#include <nvtx3/nvtx3.hpp>

#include "cuda/check.h"

namespace spindrift::gpu
{

namespace
{

constexpr int kKeyShift = 32;

// Only the bits that keys may have: CUB takes one pass for each eight of them.
cudaError_t run(void* working, std::size_t& bytes, cub::DoubleBuffer<std::uint64_t>& pairs, std::size_t n,
                int key_bits, cudaStream_t stream)
{
    return cub::DeviceRadixSort::SortKeys(working, bytes, pairs, static_cast<std::uint32_t>(n), kKeyShift,
                                          kKeyShift + key_bits, stream);
}

std::size_t working_bytes(std::size_t capacity)
{
    std::size_t most = 0;
    for (const int key_bits : {16, 24, 32})
    {
        std::size_t bytes = 0;
        cub::DoubleBuffer<std::uint64_t> pairs(nullptr, nullptr);
        check(run(nullptr, bytes, pairs, capacity, key_bits, nullptr), "cub::DeviceRadixSort (size)");
        most = std::max(most, bytes);
    }
    return most;
}

}  // namespace

CubRadix::CubRadix(std::size_t capacity) : working_(working_bytes(capacity)) {}

std::uint64_t* CubRadix::sort(StreamRef stream, const SortJob& job)
{
    if (job.n < 2) return job.pairs;
    const nvtx3::scoped_range range("sort: cub-radix");
    cub::DoubleBuffer<std::uint64_t> pairs(job.pairs, job.scratch);
    std::size_t bytes = working_.bytes();
    check(run(working_.data(), bytes, pairs, job.n, job.key_bits, stream.get()), "cub::DeviceRadixSort");
    return pairs.Current();
}

namespace sorts
{

SortStrategy cub_radix()
{
    return {
        .name = "cub-radix",
        .about = "CUB's radix sort over the depth bits alone",
        .make = [](std::size_t capacity) -> std::unique_ptr<DeviceSort>
        { return std::make_unique<CubRadix>(capacity); },
        .max_key_bits = 32,
        // one read for all histograms, then each pass reads and writes
        .bytes_per_pair = [](std::size_t, int key_bits, int) { return 8.0 + 16.0 * ((key_bits + 7) / 8); }};
}

}  // namespace sorts

}  // namespace spindrift::gpu
