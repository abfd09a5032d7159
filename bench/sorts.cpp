// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "cpu/sort/inversions.h"
#include "measure/pinned_threads.h"
#include "measure/sort_contender.h"
#include "measure/sort_keys.h"
#include "measure/timing.h"

// Rows sort/PATTERN/SIZE/[cuda/]STRATEGY[/BITS-bit]. All rows of one pattern, size and backend are measured
// together, strategy after strategy within each round, so that what else the machine does hits all of them; a
// row reports its median. Those on a device are timed by its events.

namespace spindrift::bench
{

using namespace measure;

namespace
{

struct Size
{
    std::string_view name;
    std::size_t n;
};

// Those of the report's Table 4.1, then two more.
constexpr std::array kSizes{Size{"15K", 15'000},   Size{"65K", 65'000},    Size{"250K", 250'000},
                            Size{"500K", 500'000}, Size{"1M", 1'000'000},  Size{"2M", 2'000'000},
                            Size{"4M", 4'000'000}, Size{"16M", 16'000'000}};
constexpr int kPasses = 8;  // a frame, of sorts over frames; the default of scenes

// What the floor of a row moves. A library says nothing of its passes: it must at least read and write each
// pair once.
double floor_bytes(const SortTraits& traits, std::size_t n)
{
    const double own = traits.bytes_per_pair(n, kPasses);
    return own == 0 ? 16 : own;
}

/// The series of all contenders of a backend on one input.
class Comparison
{
  public:
    Comparison(KeyPattern pattern, std::size_t n, const WantedSorts& wanted)
        : n_(n), source_(pattern, n), contenders_(make_contenders(wanted, n, source_.slots()))
    {
        series_.resize(contenders_.size());
        measure();
        contenders_.clear();
    }

    void report(benchmark::State& state, const SortTraits& traits, std::size_t row) const
    {
        const double median_ms = quantile(series_[row].sort_ms, 0.5);
        const double floor_ms = quantile(series_[row].floor_ms, 0.5);
        for (auto _ : state) state.SetIterationTime(median_ms * 1e-3);
        state.counters["ns/pair"] = median_ms * 1e6 / static_cast<double>(n_);
        state.counters["x_floor"] = median_ms / floor_ms;
        state.counters["of_copy_speed"] = floor_ms / median_ms;
        state.counters["x_best_library"] = median_ms / best_library_ms_.at(traits.backend);
        state.counters["fastest_ms"] = quantile(series_[row].sort_ms, 0);
        state.counters["rounds"] = static_cast<double>(series_[row].sort_ms.size());
        state.counters["bytes/pair"] = floor_bytes(traits, n_);
        if (traits.network) state.counters["inversion_fraction"] = series_[row].inversions;
    }

  private:
    struct Series
    {
        std::vector<double> sort_ms, floor_ms;
        double inversions = 0;  // after the last round
    };

    void measure()
    {
        constexpr std::size_t kFewestRounds = 5;
        constexpr std::size_t kMostRounds = 101;
        constexpr double kEnough_ms = 300;          // for one contender
        constexpr double kEnoughOfAll_ms = 10'000;  // with bringing and looking at the pairs
        const PinnedThreads pinned;
        std::vector<double> spent_ms(contenders_.size());
        double all_ms = 0;
        for (std::size_t round = 0; round < kMostRounds; ++round)
        {
            if (round >= kFewestRounds && all_ms > kEnoughOfAll_ms) break;
            all_ms += time_ms([&] { measure_round(round, kFewestRounds, kEnough_ms, spent_ms); });
        }
        for (std::size_t i = 0; i < contenders_.size(); ++i)
            note_library(contenders_[i]->traits(), series_[i]);
    }

    void measure_round(std::size_t round, std::size_t fewest, double enough_ms, std::vector<double>& spent_ms)
    {
        next_frame();
        for (std::size_t i = 0; i < contenders_.size(); ++i)
        {
            if (round >= fewest && spent_ms[i] > enough_ms) continue;
            run(*contenders_[i], series_[i], round + 1 >= fewest);
            spent_ms[i] += series_[i].sort_ms.back();
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

    void run(SortContender& contender, Series& series, bool may_be_last)
    {
        const SortTraits& traits = contender.traits();
        contender.load(inputs_.at(traits.key_bits));
        series.sort_ms.push_back(contender.sort_ms(kPasses, SortStart::as_kept));
        const auto result = contender.result();
        if (traits.network && may_be_last)
            series.inversions = cpu::inversion_fraction(result);
        else if (!traits.network && !std::is_sorted(result.begin(), result.end()))
            std::abort();  // a time for a wrong order means nothing
        series.floor_ms.push_back(contender.copy_ms(floor_bytes(traits, n_)));
    }

    void note_library(const SortTraits& traits, const Series& series)
    {
        auto [best, is_new] =
            best_library_ms_.try_emplace(traits.backend, std::numeric_limits<double>::infinity());
        if (traits.library) best->second = std::min(best->second, quantile(series.sort_ms, 0.5));
    }

    std::size_t n_;
    PairSource source_;
    std::map<int, std::vector<std::uint64_t>> inputs_{{32, {}}, {24, {}}, {16, {}}};  // by key bits
    std::vector<std::unique_ptr<SortContender>> contenders_;
    std::vector<Series> series_;
    std::map<std::string, double> best_library_ms_;  // by backend
};

// Kept until a row of another input or backend is asked for.
const Comparison& comparison_of(KeyPattern pattern, std::size_t n, const std::string& backend)
{
    static std::unique_ptr<Comparison> newest;
    static std::tuple<KeyPattern, std::size_t, std::string> of;
    const std::tuple asked{pattern, n, backend};
    if (!newest || of != asked)
    {
        newest.reset();
        newest = std::make_unique<Comparison>(
            pattern, n, WantedSorts{.cpu = backend == "cpu", .cuda = backend == "cuda", .strategies = {}});
        of = asked;
    }
    return *newest;
}

bool register_rows()
{
    const auto add = [](KeyPattern pattern, const Size& size, const SortTraits& traits, std::size_t row)
    {
        const auto name = fmt::format("sort/{}/{}/{}", pattern_name(pattern), size.name, traits.name);
        benchmark::RegisterBenchmark(
            name.c_str(), [=](benchmark::State& state)
            { comparison_of(pattern, size.n, traits.backend).report(state, traits, row); })
            ->UseManualTime()
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
    };
    const std::array backends{list_sorts({.cpu = true, .cuda = false, .strategies = {}}),
                              list_sorts({.cpu = false, .cuda = true, .strategies = {}})};
    for (const KeyPattern pattern : kKeyPatterns)
        for (const Size& size : kSizes)
            for (const auto& sorts : backends)
                for (std::size_t row = 0; row < sorts.size(); ++row) add(pattern, size, sorts[row], row);
    return true;
}

[[maybe_unused]] const bool registered = register_rows();

}  // namespace

}  // namespace spindrift::bench
