// SPDX-License-Identifier: MIT
#include "measure/cpu_sorts.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "cpu/huge_pages.h"
#include "cpu/sort/passes.h"
#include "cpu/sort/strategy.h"
#include "measure/pinned_threads.h"
#include "measure/timing.h"

namespace spindrift::measure
{

namespace
{

bool is_library(std::string_view name)
{
    constexpr std::array<std::string_view, 5> libraries{"qsort", "std", "std-par", "vqsort",
                                                        "block-indirect"};
    return std::ranges::find(libraries, name) != libraries.end();
}

double passes_bytes(Network network, std::size_t n, int passes)
{
    const auto steps = static_cast<double>(std::max<std::size_t>(network_steps(network, n), 1));
    const double sweeps_a_step =
        network == Network::bitonic ? static_cast<double>(bitonic_sweeps(n)) / steps : 1;
    return kKeptOrderBytesPerPair + 16 * sweeps_a_step * passes;
}

SortTraits traits_of(const cpu::SortStrategy& strategy, int key_bits)
{
    SortTraits traits;
    traits.strategy = strategy.name;
    traits.name = key_bits == strategy.max_key_bits ? traits.strategy
                                                    : fmt::format("{}/{}-bit", strategy.name, key_bits);
    traits.backend = "cpu";
    traits.about = strategy.about;
    traits.key_bits = key_bits;
    traits.library = is_library(strategy.name);
    traits.exact = strategy.sort != nullptr;
    traits.network = strategy.network;
    const bool full = key_bits == strategy.max_key_bits;
    // two passes do for 24 and 16 bits
    const double own = full ? strategy.bytes_moved_per_pair_32 : 8 + 2 * 16;
    if (strategy.network)
        traits.bytes_per_pair = [network = *strategy.network](std::size_t n, int passes)
        { return passes_bytes(network, n, passes); };
    else
        traits.bytes_per_pair = [own](std::size_t, int) { return own; };
    return traits;
}

struct Arrays
{
    explicit Arrays(std::size_t n) : pairs(n), scratch(n)
    {
        for (auto* array : {&pairs, &scratch})  // as the program's draw list
            cpu::ask_for_huge_pages(array->data(), n * sizeof(std::uint64_t));
    }
    std::vector<std::uint64_t> pairs, scratch;
};

class CpuContender final : public SortContender
{
  public:
    CpuContender(SortTraits traits, std::shared_ptr<Arrays> arrays, std::size_t slots)
        : SortContender(std::move(traits)),
          strategy_(*cpu::find_sort_strategy(this->traits().strategy)),
          arrays_(std::move(arrays)),
          slots_(slots)
    {
        if (strategy_.network) passes_.emplace(*strategy_.network, slots);
    }

    // The parallel copy also wakes the workers, as the culling before a sort does.
    void load(std::span<const std::uint64_t> pairs) override
    {
        parallel_copy(arrays_->pairs.data(), pairs.data(), pairs.size_bytes());
        n_ = pairs.size();
    }

    double sort_ms(int passes, SortStart start) override
    {
        const cpu::SortJob job{arrays_->pairs.data(), arrays_->scratch.data(), n_, traits().key_bits};
        const bool own_threads = strategy_.name == "block-indirect";
        const auto free = own_threads ? std::make_unique<AnyCore>() : nullptr;
        return time_ms(
            [&]
            {
                result_ = passes_                     ? passes_->sort(job, passes, start)
                          : strategy_.sort != nullptr ? strategy_.sort(job)
                                                      : job.pairs;
            });
    }

    void follow(std::span<const std::uint32_t> sources) override
    {
        if (passes_) std::ranges::copy(moved_ranks({passes_->ranks(), slots_}, sources), passes_->ranks());
    }

    std::span<const std::uint64_t> result() override { return {result_, n_}; }

    double copy_ms(double bytes_per_pair) override
    {
        const double array_bytes = static_cast<double>(n_ * sizeof(std::uint64_t));
        return time_ms(
            [&]
            {
                std::uint64_t* from = arrays_->pairs.data();
                std::uint64_t* to = arrays_->scratch.data();
                for (double copies = bytes_per_pair / 16; copies > 0; copies -= 1)
                {
                    parallel_copy(to, from, static_cast<std::size_t>(std::min(copies, 1.0) * array_bytes));
                    std::swap(from, to);
                }
            });
    }

  private:
    const cpu::SortStrategy& strategy_;
    std::shared_ptr<Arrays> arrays_;
    std::size_t slots_;
    std::optional<cpu::PassSorter> passes_;
    std::size_t n_ = 0;
    const std::uint64_t* result_ = nullptr;
};

}  // namespace

std::vector<SortTraits> cpu_sorts()
{
    std::vector<SortTraits> all;
    for (const cpu::SortStrategy& strategy : cpu::sort_strategies())
        all.push_back(traits_of(strategy, strategy.max_key_bits));
    for (const int key_bits : {24, 16}) all.push_back(traits_of(*cpu::find_sort_strategy("radix"), key_bits));
    return all;
}

std::vector<std::unique_ptr<SortContender>> make_cpu_contenders(std::vector<SortTraits> sorts,
                                                                std::size_t pairs, std::size_t slots)
{
    std::vector<std::unique_ptr<SortContender>> all;
    const auto arrays = std::make_shared<Arrays>(sorts.empty() ? 0 : pairs);
    for (SortTraits& traits : sorts)
        all.push_back(std::make_unique<CpuContender>(std::move(traits), arrays, slots));
    return all;
}

}  // namespace spindrift::measure
