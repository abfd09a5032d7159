// SPDX-License-Identifier: MIT
#include <thrust/sort.h>
#include <thrust/system/cuda/execution_policy.h>
#include <thrust/system_error.h>
#include <cub/device/device_radix_sort.cuh>
#include <nvtx3/nvtx3.hpp>

#include "core/error.h"
#include "cuda/buffer.h"
#include "cuda/launch.cuh"
#include "cuda/sort/strategy.h"

namespace spindrift::gpu
{

namespace
{

/// Thrust takes its working memory anew in each call; this gives it the same block each time.
class OneBlock
{
  public:
    using value_type = char;

    OneBlock(char* block, std::size_t size) : block_(block), size_(size) {}
    char* allocate(std::ptrdiff_t bytes)
    {
        if (static_cast<std::size_t>(bytes) > size_)
            throw Error("CUDA: thrust asked for more working memory than was set aside");
        return block_;
    }
    void deallocate(char*, std::size_t) {}

  private:
    char* block_;
    std::size_t size_;
};

struct Split
{
    const std::uint64_t* pairs;
    std::uint32_t* keys;
    std::uint32_t* slots;
    __device__ void operator()(std::size_t i) const
    {
        keys[i] = static_cast<std::uint32_t>(pairs[i] >> 32);
        slots[i] = static_cast<std::uint32_t>(pairs[i]);
    }
};

struct Join
{
    const std::uint32_t* keys;
    const std::uint32_t* slots;
    std::uint64_t* pairs;
    __device__ void operator()(std::size_t i) const { pairs[i] = std::uint64_t{keys[i]} << 32 | slots[i]; }
};

// As Thrust adds it up: a second copy of keys and values, and what CUB asks for.
std::size_t working_bytes(std::size_t capacity)
{
    constexpr std::size_t kAlignment = 512;
    std::size_t bytes = 0;
    cub::DoubleBuffer<std::uint32_t> keys(nullptr, nullptr), slots(nullptr, nullptr);
    check(cub::DeviceRadixSort::SortPairs(nullptr, bytes, keys, slots, static_cast<std::ptrdiff_t>(capacity)),
          "cub::DeviceRadixSort (size)");
    return bytes + 2 * capacity * sizeof(std::uint32_t) + 4 * kAlignment;
}

class ThrustSort final : public DeviceSort
{
  public:
    explicit ThrustSort(std::size_t capacity) : working_(working_bytes(capacity)) {}

    std::uint64_t* sort(StreamRef stream, const SortJob& job) override
    {
        if (job.n < 2) return job.pairs;
        auto* const keys = reinterpret_cast<std::uint32_t*>(job.scratch);
        auto* const slots = keys + job.n;
        launch(stream, "sort: thrust, split", job.n, Split{job.pairs, keys, slots});
        OneBlock block(working_.data(), working_.size());
        const nvtx3::scoped_range range("sort: thrust");
        try
        {
            // stable, so that equal keys keep ascending slots; nosync, since the stream is not to be waited
            // for
            thrust::stable_sort_by_key(thrust::cuda::par_nosync(block).on(stream.get()), keys, keys + job.n,
                                       slots);
        }
        catch (const thrust::system_error& error)
        {
            throw_call_failed(static_cast<cudaError_t>(error.code().value()), "thrust::stable_sort_by_key");
        }
        launch(stream, "sort: thrust, join", job.n, Join{keys, slots, job.pairs});
        return job.pairs;
    }

  private:
    DeviceBuffer<char> working_;
};

}  // namespace

namespace sorts
{

SortStrategy thrust_sort()
{
    return {.name = "thrust",
            .about = "thrust::stable_sort_by_key of keys and slots, always over 32 bits",
            .make = [](std::size_t capacity) -> std::unique_ptr<DeviceSort>
            { return std::make_unique<ThrustSort>(capacity); },
            .max_key_bits = 32,
            // split, read the keys, four passes, join
            .bytes_per_pair = [](std::size_t, int, int) { return 16.0 + 4.0 + 4 * 16.0 + 16.0; }};
}

}  // namespace sorts

}  // namespace spindrift::gpu
