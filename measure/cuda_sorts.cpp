// SPDX-License-Identifier: MIT
#include "measure/cuda_sorts.h"

#include <algorithm>

#include <fmt/format.h>

#include "cuda/buffer.h"
#include "cuda/device.h"
#include "cuda/sort/strategy.h"
#include "cuda/stream.h"

namespace spindrift::measure
{

namespace
{

SortTraits traits_of(const gpu::SortStrategy& strategy, int key_bits)
{
    SortTraits traits;
    traits.strategy = strategy.name;
    traits.name = fmt::format("cuda/{}", strategy.name);
    if (key_bits != strategy.max_key_bits) traits.name += fmt::format("/{}-bit", key_bits);
    traits.backend = "cuda";
    traits.about = strategy.about;
    traits.key_bits = key_bits;
    traits.library =
        strategy.name == "cub-radix" || strategy.name == "thrust" || strategy.name == "cub-merge";
    traits.exact = !strategy.network;
    traits.network = strategy.network;
    traits.bytes_per_pair = [bytes = strategy.bytes_per_pair, key_bits](std::size_t n, int passes)
    { return bytes(n, key_bits, passes); };
    return traits;
}

struct Arrays
{
    explicit Arrays(std::size_t n) : pairs(n), scratch(n) {}
    gpu::Stream stream;
    gpu::DeviceBuffer<std::uint64_t> pairs, scratch;
};

class CudaContender final : public SortContender
{
  public:
    CudaContender(SortTraits traits, std::shared_ptr<Arrays> arrays, std::size_t slots)
        : SortContender(std::move(traits)),
          slots_(slots),
          sort_(
              gpu::find_sort_strategy(this->traits().strategy)->make(std::max(slots, arrays->pairs.size()))),
          arrays_(std::move(arrays))
    {
    }

    void load(std::span<const std::uint64_t> pairs) override
    {
        gpu::copy_to_device(arrays_->stream, arrays_->pairs.data(), pairs.data(), pairs.size());
        arrays_->stream.ref().wait();
        n_ = pairs.size();
    }

    double sort_ms(int passes, SortStart start) override
    {
        const gpu::SortJob job{
            arrays_->pairs.data(), arrays_->scratch.data(), n_, traits().key_bits, passes, start};
        return between_events([&] { result_ = sort_->sort(arrays_->stream, job); });
    }

    // by way of the host: it is not timed
    void follow(std::span<const std::uint32_t> sources) override
    {
        if (sort_->ranks() == nullptr) return;
        std::vector<std::uint32_t> ranks(slots_);
        gpu::copy_to_host(arrays_->stream, ranks.data(), sort_->ranks(), slots_);
        arrays_->stream.ref().wait();
        ranks = moved_ranks(ranks, sources);
        gpu::copy_to_device(arrays_->stream, sort_->ranks(), ranks.data(), slots_);
        arrays_->stream.ref().wait();
    }

    std::span<const std::uint64_t> result() override
    {
        host_.resize(n_);
        gpu::copy_to_host(arrays_->stream, host_.data(), result_, n_);
        arrays_->stream.ref().wait();
        return host_;
    }

    double copy_ms(double bytes_per_pair) override
    {
        const double array_bytes = static_cast<double>(n_ * sizeof(std::uint64_t));
        std::uint64_t* from = arrays_->pairs.data();
        std::uint64_t* to = arrays_->scratch.data();
        return between_events(
            [&]
            {
                for (double copies = bytes_per_pair / 16; copies > 0; copies -= 1)
                {
                    const double bytes = std::min(copies, 1.0) * array_bytes;
                    gpu::check(cudaMemcpyAsync(to, from, static_cast<std::size_t>(bytes),
                                               cudaMemcpyDeviceToDevice, arrays_->stream.ref().get()),
                               "cudaMemcpyAsync on the device");
                    std::swap(from, to);
                }
            });
    }

  private:
    template <class Work>
    double between_events(const Work& work)
    {
        begin_.record(arrays_->stream);
        work();
        end_.record(arrays_->stream);
        end_.wait();
        return end_.ms_since(begin_);
    }

    std::size_t slots_;
    std::unique_ptr<gpu::DeviceSort> sort_;
    std::shared_ptr<Arrays> arrays_;
    gpu::Event begin_{gpu::Event::Timing::on}, end_{gpu::Event::Timing::on};
    std::size_t n_ = 0;
    const std::uint64_t* result_ = nullptr;
    std::vector<std::uint64_t> host_;
};

}  // namespace

std::vector<SortTraits> cuda_sorts()
{
    std::vector<SortTraits> all;
    if (!no_cuda_because().empty()) return all;
    for (const gpu::SortStrategy& strategy : gpu::sort_strategies())
        if (strategy.make != nullptr) all.push_back(traits_of(strategy, strategy.max_key_bits));
    for (const int key_bits : {24, 16})
        all.push_back(traits_of(*gpu::find_sort_strategy("cub-radix"), key_bits));
    return all;
}

std::vector<std::unique_ptr<SortContender>> make_cuda_contenders(std::vector<SortTraits> sorts,
                                                                 std::size_t pairs, std::size_t slots)
{
    std::vector<std::unique_ptr<SortContender>> all;
    if (sorts.empty()) return all;
    const auto arrays = std::make_shared<Arrays>(pairs);
    for (SortTraits& traits : sorts)
        all.push_back(std::make_unique<CudaContender>(std::move(traits), arrays, slots));
    return all;
}

std::string no_cuda_because()
{
    static const gpu::Devices devices = gpu::find_devices();
    return devices.list.empty() ? devices.none_because : "";
}

}  // namespace spindrift::measure
