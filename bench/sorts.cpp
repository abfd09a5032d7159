// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "measure/pinned_threads.h"
#include "measure/sort_keys.h"
#include "measure/timing.h"
#include "cpu/sort/strategy.h"

// Rows sort/PATTERN/SIZE/STRATEGY[/BITS-bit]. All rows of one pattern and size are measured together,
// strategy after strategy within each round, so that what else the machine does hits all of them; a row
// reports its median.

namespace spindrift::bench
{

namespace
{

using cpu::SortStrategy;

struct Size
{
    std::string_view name;
    std::size_t n;
};

// Those of the report's Table 4.1, then two more.
constexpr std::array kSizes{Size{"15K", 15'000},   Size{"65K", 65'000},    Size{"250K", 250'000},
                            Size{"500K", 500'000}, Size{"1M", 1'000'000},  Size{"2M", 2'000'000},
                            Size{"4M", 4'000'000}, Size{"16M", 16'000'000}};
constexpr std::array kPatterns{KeyPattern::random, KeyPattern::nearly_sorted, KeyPattern::equal,
                               KeyPattern::camera_sweep};

struct Contender
{
    const SortStrategy* strategy;
    int key_bits;

    bool is_library() const
    {
        constexpr std::array<std::string_view, 5> libraries{"qsort", "std", "std-par", "vqsort",
                                                            "block-indirect"};
        return std::ranges::find(libraries, strategy->name) != libraries.end();
    }

    std::string row_name() const
    {
        const bool full = key_bits == strategy->max_key_bits;
        return full ? std::string(strategy->name) : fmt::format("{}/{}-bit", strategy->name, key_bits);
    }

    // What its passes must move: K + 2P(K + V) with pairs of 8 bytes that are read whole. Two passes do for
    // 24 and 16 bits. A library says nothing of its passes: it must at least read and write each pair once.
    double bytes_per_pair() const
    {
        if (strategy->bytes_moved_per_pair_32 == 0) return 16;
        return key_bits == strategy->max_key_bits ? strategy->bytes_moved_per_pair_32 : 8 + 2 * 16;
    }
};

std::vector<Contender> contenders()
{
    std::vector<Contender> all;
    for (const SortStrategy& strategy : cpu::sort_strategies())
        if (strategy.sort) all.push_back({&strategy, strategy.max_key_bits});
    const SortStrategy* radix = cpu::find_sort_strategy("radix");
    all.push_back({radix, 24});
    all.push_back({radix, 16});
    return all;
}

/// The series of all contenders on one input.
class Comparison
{
  public:
    Comparison(KeyPattern pattern, std::size_t n)
        : n_(n), source_(pattern, n), pairs_(n), scratch_(n), contenders_(contenders())
    {
        sort_ms_.resize(contenders_.size());
        floor_ms_.resize(contenders_.size());
        measure();
    }

    void report(benchmark::State& state, std::size_t row) const
    {
        const double median_ms = quantile(sort_ms_[row], 0.5);
        double library_ms = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < contenders_.size(); ++i)
            if (contenders_[i].is_library()) library_ms = std::min(library_ms, quantile(sort_ms_[i], 0.5));

        for (auto _ : state) state.SetIterationTime(median_ms * 1e-3);
        state.counters["ns/pair"] = median_ms * 1e6 / static_cast<double>(n_);
        state.counters["x_floor"] = median_ms / quantile(floor_ms_[row], 0.5);
        state.counters["x_best_library"] = median_ms / library_ms;
        state.counters["fastest_ms"] = quantile(sort_ms_[row], 0);
        state.counters["rounds"] = static_cast<double>(sort_ms_[row].size());
        state.counters["bytes/pair"] = contenders_[row].bytes_per_pair();
    }

  private:
    void measure()
    {
        constexpr std::size_t kFewestRounds = 5;
        constexpr std::size_t kMostRounds = 101;
        constexpr double kEnough_ms = 300;  // for one contender
        const PinnedThreads pinned;
        std::vector<double> spent_ms(contenders_.size());
        for (std::size_t round = 0; round < kMostRounds; ++round)
        {
            next_frame();
            for (std::size_t i = 0; i < contenders_.size(); ++i)
            {
                if (round >= kFewestRounds && spent_ms[i] > kEnough_ms) continue;
                sort_ms_[i].push_back(time_sort(contenders_[i]));
                floor_ms_[i].push_back(time_floor(contenders_[i]));
                spent_ms[i] += sort_ms_[i].back();
            }
        }
    }

    void next_frame()
    {
        const auto frame = source_.next_frame();
        for (auto& [key_bits, input] : inputs_)
        {
            input.resize(frame.size());
            for (std::size_t i = 0; i < frame.size(); ++i) input[i] = source_.narrowed(frame[i], key_bits);
        }
    }

    // The parallel copy also wakes the workers, as the culling before a sort does. Returns the number of
    // pairs.
    std::size_t refill(int key_bits)
    {
        const auto& input = inputs_.at(key_bits);
        parallel_copy(pairs_.data(), input.data(), input.size() * sizeof(std::uint64_t));
        return input.size();
    }

    double time_sort(const Contender& contender)
    {
        const std::size_t n = refill(contender.key_bits);
        const cpu::SortJob job{pairs_.data(), scratch_.data(), n, contender.key_bits};
        const std::uint64_t* sorted = nullptr;
        const bool own_threads = contender.strategy->name == "block-indirect";
        const auto free = own_threads ? std::make_unique<AnyCore>() : nullptr;
        const double ms = time_ms([&] { sorted = contender.strategy->sort(job); });
        if (!std::is_sorted(sorted, sorted + job.n)) std::abort();  // a time for a wrong order means nothing
        return ms;
    }

    // Copies between the two arrays to and fro until the bytes that the contender's passes must move have
    // moved.
    double time_floor(const Contender& contender)
    {
        const std::size_t n = refill(contender.key_bits);
        const double array_bytes = static_cast<double>(n * sizeof(std::uint64_t));
        return time_ms(
            [&]
            {
                std::uint64_t* from = pairs_.data();
                std::uint64_t* to = scratch_.data();
                for (double copies = contender.bytes_per_pair() / 16; copies > 0; copies -= 1)
                {
                    parallel_copy(to, from, static_cast<std::size_t>(std::min(copies, 1.0) * array_bytes));
                    std::swap(from, to);
                }
            });
    }

    std::size_t n_;
    PairSource source_;
    std::map<int, std::vector<std::uint64_t>> inputs_{{32, {}}, {24, {}}, {16, {}}};  // by key bits
    std::vector<std::uint64_t> pairs_, scratch_;
    std::vector<Contender> contenders_;
    std::vector<std::vector<double>> sort_ms_, floor_ms_;
};

// Kept until a row of another input is asked for.
const Comparison& comparison_of(KeyPattern pattern, std::size_t n)
{
    static std::unique_ptr<Comparison> newest;
    static std::pair<KeyPattern, std::size_t> of;
    if (!newest || of != std::pair{pattern, n})
    {
        newest.reset();
        newest = std::make_unique<Comparison>(pattern, n);
        of = {pattern, n};
    }
    return *newest;
}

bool register_rows()
{
    const auto all = contenders();
    for (const KeyPattern pattern : kPatterns)
        for (const Size& size : kSizes)
            for (std::size_t row = 0; row < all.size(); ++row)
            {
                const auto name =
                    fmt::format("sort/{}/{}/{}", pattern_name(pattern), size.name, all[row].row_name());
                benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state)
                                             { comparison_of(pattern, size.n).report(state, row); })
                    ->UseManualTime()
                    ->Iterations(1)
                    ->Unit(benchmark::kMillisecond);
            }
    return true;
}

[[maybe_unused]] const bool registered = register_rows();

}  // namespace

}  // namespace spindrift::bench
