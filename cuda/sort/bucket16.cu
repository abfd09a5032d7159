// SPDX-License-Identifier: MIT
#include <utility>

#include "core/sort_network.h"
#include "cuda/buffer.h"
#include "cuda/launch.cuh"
#include "cuda/sort/put_in_order.cuh"
#include "cuda/sort/strategy.h"

// One counting pass over 65 536 buckets. Threads reach a bucket in any order, so each bucket is then sorted
// by whole pairs, which puts its slots in ascending order: the outcome is the stable one.

namespace spindrift::gpu
{

namespace
{

constexpr unsigned kBuckets = 1U << 16;
constexpr unsigned kWarp = 32;
constexpr unsigned kWarps = kBlockThreads / kWarp;  // buckets of a block
constexpr unsigned kTile = kNetworkTile;            // 32 KiB of shared memory
constexpr unsigned kBlocks = 1024;                  // enough for any device; each takes buckets in turn
constexpr unsigned kScanThreads = 1024;

__device__ unsigned bucket_of(std::uint64_t pair)
{
    return static_cast<unsigned>(pair >> 32) & (kBuckets - 1);
}

struct Count
{
    const std::uint64_t* pairs;
    std::uint32_t* counts;
    __device__ void operator()(std::size_t i) const { atomicAdd(&counts[bucket_of(pairs[i])], 1U); }
};

/// One block: counts to the first place of each bucket.
struct CountsToPlaces
{
    std::uint32_t* counts;

    __device__ void operator()() const
    {
        constexpr unsigned kEach = kBuckets / kScanThreads;
        __shared__ std::uint32_t sums[kScanThreads];
        std::uint32_t* const own = counts + threadIdx.x * kEach;
        std::uint32_t sum = 0;
        for (unsigned i = 0; i < kEach; ++i) sum += own[i];
        sums[threadIdx.x] = sum;
        for (unsigned reach = 1; reach < kScanThreads; reach *= 2)
        {
            __syncthreads();
            const std::uint32_t before = threadIdx.x >= reach ? sums[threadIdx.x - reach] : 0;
            __syncthreads();
            sums[threadIdx.x] += before;
        }
        std::uint32_t place = sums[threadIdx.x] - sum;
        for (unsigned i = 0; i < kEach; ++i)
        {
            const std::uint32_t count = own[i];
            own[i] = place;
            place += count;
        }
    }
};

struct Scatter
{
    const std::uint64_t* pairs;
    std::uint32_t* places;  // afterwards: the ends of the buckets
    std::uint64_t* to;
    __device__ void operator()(std::size_t i) const
    {
        to[atomicAdd(&places[bucket_of(pairs[i])], 1U)] = pairs[i];
    }
};

/// All threads of a block sort `size` pairs in shared or global memory: the bitonic network of core/.
__device__ void sort_by_block(std::uint64_t* pairs, unsigned size)
{
    for (unsigned block = 2; block / 2 < size; block *= 2)
        for (unsigned half = block / 2; half > 0; half /= 2)
        {
            const NetworkStep step{half == block / 2 ? block - 1 : half, half, 0};
            const std::size_t comparators = step.comparators(size);
            for (std::size_t c = threadIdx.x; c < comparators; c += kBlockThreads)
            {
                const std::size_t upper = step.upper(c);
                put_in_order(pairs[step.lower(upper)], pairs[upper]);
            }
            __syncthreads();
        }
}

/// A warp for each small bucket, then the block for each of its larger ones. More than 4096 pairs in one
/// bucket are sorted in global memory: slow, but never quadratic.
struct SortBuckets
{
    std::uint64_t* pairs;
    const std::uint32_t* ends;

    __device__ std::uint32_t begin_of(unsigned bucket) const { return bucket == 0 ? 0 : ends[bucket - 1]; }

    __device__ void sort_by_warp(std::uint64_t* first, unsigned size) const
    {
        const unsigned lane = threadIdx.x % kWarp;
        const std::uint64_t own = lane < size ? first[lane] : ~std::uint64_t{0};
        unsigned rank = 0;
        for (unsigned other = 0; other < kWarp; ++other)
            rank += __shfl_sync(~0U, own, static_cast<int>(other)) < own ? 1U : 0U;
        if (lane < size) first[rank] = own;
    }

    __device__ void sort_by_block_in_tile(std::uint64_t* first, unsigned size, std::uint64_t* tile) const
    {
        for (unsigned i = threadIdx.x; i < size; i += kBlockThreads) tile[i] = first[i];
        __syncthreads();
        sort_by_block(tile, size);
        for (unsigned i = threadIdx.x; i < size; i += kBlockThreads) first[i] = tile[i];
        __syncthreads();
    }

    __device__ void operator()() const
    {
        __shared__ std::uint64_t tile[kTile];
        for (unsigned group = blockIdx.x * kWarps; group < kBuckets; group += gridDim.x * kWarps)
        {
            const unsigned own = group + threadIdx.x / kWarp;
            const unsigned own_size = ends[own] - begin_of(own);
            if (own_size > 1 && own_size <= kWarp) sort_by_warp(pairs + begin_of(own), own_size);
            for (unsigned bucket = group; bucket < group + kWarps; ++bucket)
            {
                const unsigned size = ends[bucket] - begin_of(bucket);
                if (size <= kWarp) continue;
                if (size <= kTile)
                    sort_by_block_in_tile(pairs + begin_of(bucket), size, tile);
                else
                    sort_by_block(pairs + begin_of(bucket), size);
            }
        }
    }
};

class Bucket16 final : public DeviceSort
{
  public:
    Bucket16() : places_(kBuckets) {}

    std::uint64_t* sort(StreamRef stream, const SortJob& job) override
    {
        if (job.n < 2) return job.pairs;
        check(cudaMemsetAsync(places_.data(), 0, places_.bytes(), stream.get()), "cudaMemsetAsync");
        launch(stream, "sort: bucket16, count", job.n, Count{job.pairs, places_.data()});
        launch_blocks(stream, "sort: bucket16, places", 1, kScanThreads, CountsToPlaces{places_.data()});
        launch(stream, "sort: bucket16, scatter", job.n, Scatter{job.pairs, places_.data(), job.scratch});
        launch_blocks(stream, "sort: bucket16, buckets", kBlocks, kBlockThreads,
                      SortBuckets{job.scratch, places_.data()});
        return job.scratch;
    }

  private:
    DeviceBuffer<std::uint32_t> places_;
};

}  // namespace

namespace sorts
{

SortStrategy bucket16()
{
    return {.name = "bucket16",
            .about = "one counting pass over 16-bit depth keys, then slots in order within each bucket",
            .make = [](std::size_t) -> std::unique_ptr<DeviceSort> { return std::make_unique<Bucket16>(); },
            .max_key_bits = 16,
            // read to count, read and write to move, read and write to order
            .bytes_per_pair = [](std::size_t, int, int) { return 8.0 + 16.0 + 16.0; }};
}

}  // namespace sorts

}  // namespace spindrift::gpu
