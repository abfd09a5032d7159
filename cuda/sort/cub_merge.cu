// SPDX-License-Identifier: MIT
#include <bit>

#include <cub/device/device_merge_sort.cuh>
#include <nvtx3/nvtx3.hpp>

#include "cuda/buffer.h"
#include "cuda/check.h"
#include "cuda/sort/strategy.h"

namespace spindrift::gpu
{

namespace
{

// Whole pairs: no two are equal, so the order is the one order that there is.
struct Before
{
    __device__ bool operator()(std::uint64_t a, std::uint64_t b) const { return a < b; }
};

cudaError_t run(void* working, std::size_t& bytes, std::uint64_t* pairs, std::size_t n, cudaStream_t stream)
{
    return cub::DeviceMergeSort::SortKeys(working, bytes, pairs, n, Before{}, stream);
}

std::size_t working_bytes(std::size_t capacity)
{
    std::size_t bytes = 0;
    check(run(nullptr, bytes, nullptr, capacity, nullptr), "cub::DeviceMergeSort (size)");
    return bytes;
}

class CubMerge final : public DeviceSort
{
  public:
    explicit CubMerge(std::size_t capacity) : working_(working_bytes(capacity)) {}
    std::uint64_t* sort(StreamRef stream, const SortJob& job) override
    {
        if (job.n < 2) return job.pairs;
        const nvtx3::scoped_range range("sort: cub-merge");
        std::size_t bytes = working_.bytes();
        check(run(working_.data(), bytes, job.pairs, job.n, stream.get()), "cub::DeviceMergeSort");
        return job.pairs;
    }

  private:
    DeviceBuffer<unsigned char> working_;
};

}  // namespace

namespace sorts
{

SortStrategy cub_merge()
{
    return {.name = "cub-merge",
            .about = "CUB's merge sort of whole pairs",
            .make = [](std::size_t capacity) -> std::unique_ptr<DeviceSort>
            { return std::make_unique<CubMerge>(capacity); },
            .max_key_bits = 32,
            // its tiles depend on the device
            .bytes_per_pair = [](std::size_t, int, int) { return 0.0; }};
}

}  // namespace sorts

}  // namespace spindrift::gpu
