// SPDX-License-Identifier: MIT
#include <algorithm>

#include <cub/device/device_select.cuh>
#include <nvtx3/nvtx3.hpp>

#include "cuda/buffer.h"
#include "cuda/launch.cuh"
#include "cuda/sort/cub_radix.h"
#include "cuda/sort/network_steps.h"
#include "cuda/sort/strategy.h"

namespace spindrift::gpu
{

namespace
{

constexpr std::uint64_t kNoPair = ~std::uint64_t{0};  // no slot has this number

struct IsPair
{
    __device__ bool operator()(std::uint64_t pair) const { return pair != kNoPair; }
};

struct IsNew
{
    const std::uint32_t* rank;
    __device__ bool operator()(std::uint64_t pair) const
    {
        return rank[static_cast<std::uint32_t>(pair)] == kNoRank;
    }
};

struct PutInPlace
{
    const std::uint64_t* pairs;
    const std::uint32_t* rank;
    std::uint64_t* places;
    __device__ void operator()(std::size_t i) const
    {
        const std::uint32_t place = rank[static_cast<std::uint32_t>(pairs[i])];
        if (place != kNoRank) places[place] = pairs[i];
    }
};

/// The new pairs behind those that were kept, whose number stands on the device.
struct Append
{
    const std::uint64_t* added;
    std::size_t n;
    const std::uint32_t* kept;
    std::uint64_t* pairs;
    __device__ void operator()(std::size_t i) const
    {
        if (*kept + i < n) pairs[*kept + i] = added[i];
    }
};

struct KeepRank
{
    const std::uint64_t* pairs;
    std::uint32_t* rank;
    __device__ void operator()(std::size_t i) const
    {
        rank[static_cast<std::uint32_t>(pairs[i])] = static_cast<std::uint32_t>(i);
    }
};

template <class Wanted>
cudaError_t select(void* working, std::size_t& bytes, const std::uint64_t* from, std::uint64_t* to,
                   std::uint32_t* count, std::size_t n, Wanted wanted, cudaStream_t stream)
{
    return cub::DeviceSelect::If(working, bytes, from, to, count, static_cast<std::int64_t>(n), wanted,
                                 stream);
}

std::size_t working_bytes(std::size_t capacity)
{
    std::size_t for_kept = 0, for_new = 0;
    check(select(nullptr, for_kept, nullptr, nullptr, nullptr, capacity, IsPair{}, nullptr),
          "cub::DeviceSelect (size)");
    check(select(nullptr, for_new, nullptr, nullptr, nullptr, capacity, IsNew{}, nullptr),
          "cub::DeviceSelect (size)");
    return std::max(for_kept, for_new);
}

/// As cpu::PassSorter, step by step: the same order on both backends.
class PassSort final : public DeviceSort
{
  public:
    PassSort(Network network, std::size_t capacity)
        : network_(network),
          walk_(network),
          exact_(capacity),
          rank_(capacity),
          places_(capacity),
          counts_(2),
          working_(working_bytes(capacity))
    {
        rank_.fill_now(0xFF);
    }

    std::uint64_t* sort(StreamRef stream, const SortJob& job) override
    {
        std::uint64_t* pairs = nullptr;
        if (job.start == SortStart::exact)
        {
            walk_ = NetworkWalk(network_);
            pairs = exact_.sort(stream, job);
        }
        else
        {
            put_in_kept_order(stream, job);
            pairs = run_steps(stream, job);
        }
        check(cudaMemsetAsync(rank_.data(), 0xFF, rank_.bytes(), stream.get()), "cudaMemsetAsync");
        launch(stream, "sort: keep order", job.n, KeepRank{pairs, rank_.data()});
        kept_ = job.n;
        return pairs;
    }

    std::uint32_t* ranks() const override { return rank_.data(); }

  private:
    /// From job.pairs to job.scratch.
    void put_in_kept_order(StreamRef stream, const SortJob& job)
    {
        const nvtx3::scoped_range range("sort: put in kept order");
        check(cudaMemsetAsync(places_.data(), 0xFF, kept_ * sizeof(std::uint64_t), stream.get()),
              "cudaMemsetAsync");
        launch(stream, "sort: to last places", job.n, PutInPlace{job.pairs, rank_.data(), places_.data()});
        std::uint32_t* const kept = counts_.data();
        select_if(stream, places_.data(), job.scratch, kept, kept_, IsPair{});
        select_if(stream, job.pairs, places_.data(), kept + 1, job.n, IsNew{rank_.data()});
        launch(stream, "sort: append new", job.n, Append{places_.data(), job.n, kept, job.scratch});
    }

    template <class Wanted>
    void select_if(StreamRef stream, const std::uint64_t* from, std::uint64_t* to, std::uint32_t* count,
                   std::size_t n, const Wanted& wanted)
    {
        std::size_t bytes = working_.bytes();
        check(select(working_.data(), bytes, from, to, count, n, wanted, stream.get()), "cub::DeviceSelect");
    }

    std::uint64_t* run_steps(StreamRef stream, const SortJob& job)
    {
        const auto steps = static_cast<std::size_t>(job.passes);
        if (network_ == Network::odd_even)
            return run_odd_even(stream, walk_, job.scratch, job.pairs, job.n, steps);
        run_network(stream, walk_, job.scratch, job.n, steps);
        return job.scratch;
    }

    Network network_;
    NetworkWalk walk_;
    CubRadix exact_;
    DeviceBuffer<std::uint32_t> rank_;
    DeviceBuffer<std::uint64_t> places_;  ///< pairs at their places of the last frame
    DeviceBuffer<std::uint32_t> counts_;  ///< of pairs that were kept, of new ones
    DeviceBuffer<unsigned char> working_;
    std::size_t kept_ = 0;
};

}  // namespace

namespace sorts
{

SortStrategy bitonic_passes()
{
    return {.name = "bitonic-passes",
            .about = "some steps of a bitonic network a frame on the order of the last frame; not exact",
            .make = [](std::size_t capacity) -> std::unique_ptr<DeviceSort>
            { return std::make_unique<PassSort>(Network::bitonic, capacity); },
            .max_key_bits = 32,
            .bytes_per_pair =
                [](std::size_t n, int, int passes)
            {
                const std::size_t all = std::max<std::size_t>(network_steps(Network::bitonic, n), 1);
                const double share = static_cast<double>(passes) / static_cast<double>(all);
                return kKeptOrderBytesPerPair + 16.0 * share * static_cast<double>(bitonic_sweeps(n));
            },
            .network = Network::bitonic};
}

SortStrategy odd_even_passes()
{
    return {.name = "odd-even-passes",
            .about = "the same with steps that compare neighbours: for keys that change little; not exact",
            .make = [](std::size_t capacity) -> std::unique_ptr<DeviceSort>
            { return std::make_unique<PassSort>(Network::odd_even, capacity); },
            .max_key_bits = 32,
            .bytes_per_pair = [](std::size_t, int, int passes)
            { return kKeptOrderBytesPerPair + 16.0 * ((passes + 1023) / 1024); },
            .network = Network::odd_even};
}

}  // namespace sorts

}  // namespace spindrift::gpu
