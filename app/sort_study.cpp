// SPDX-License-Identifier: MIT
#include "app/sort_study.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "cpu/sort/inversions.h"
#include "measure/timing.h"

namespace spindrift::app
{

namespace
{

std::uint32_t slot_of(std::uint64_t pair)
{
    return static_cast<std::uint32_t>(pair);
}

double mean(const std::vector<double>& values)
{
    if (values.empty()) return 0;
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double share_below(const std::vector<double>& values, double limit)
{
    const auto below = std::ranges::count_if(values, [=](double value) { return value < limit; });
    return static_cast<double>(below) / static_cast<double>(values.size());
}

}  // namespace

SortStudy::SortStudy(const measure::WantedSorts& wanted, int passes, std::size_t most_pairs,
                     std::size_t slots)
    : passes_(passes),
      slots_(slots),
      sorts_(measure::make_contenders(wanted, most_pairs, slots)),
      series_(sorts_.size())
{
}

void SortStudy::add_frame(const KeysOfFrame& keys, SortStart start, Look look, const PictureError& error)
{
    const auto& pairs = keys.of(32);
    pairs_.push_back(static_cast<double>(pairs.size()));
    exact_ = pairs;
    if (look == Look::at_order_too) std::ranges::sort(exact_);
    for (std::size_t i = 0; i < sorts_.size(); ++i)
    {
        measure::SortContender& sort = *sorts_[i];
        const int key_bits = sort.traits().key_bits;
        if (!keys.sources.empty()) sort.follow(keys.sources);
        sort.load(keys.of(key_bits));
        series_[i].sort_ms.push_back(sort.sort_ms(passes_, start));
        if (look == Look::at_order_too) look_at(sort, keys, error, series_[i]);
        series_[i].floor_ms.push_back(sort.copy_ms(measure::floor_bytes_per_pair(key_bits)));
    }
}

void SortStudy::look_at(measure::SortContender& sort, const KeysOfFrame& keys, const PictureError& error,
                        Series& series)
{
    const std::span<const std::uint64_t> order = sort.result();
    if (sort.traits().exact && !std::ranges::is_sorted(order))
        throw std::logic_error(fmt::format("{} left {} pairs out of order", sort.traits().name,
                                           keys.of(sort.traits().key_bits).size()));
    const bool same = std::ranges::equal(order, exact_, {}, slot_of, slot_of);
    series.inversions.push_back(same ? 0 : cpu::inversion_fraction(order, exact_, slots_));
    if (error) series.image_errors.push_back(same ? 0 : error(order, exact_));
}

std::vector<SortRow> SortStudy::rows(const std::string& input, const std::string& size) const
{
    constexpr double kReportsLimit_ms = 10;  // of the report: 0.01 s
    std::vector<SortRow> rows;
    const auto pairs = static_cast<std::size_t>(measure::quantile(pairs_, 0.5));
    for (std::size_t i = 0; i < sorts_.size(); ++i)
    {
        const measure::SortTraits& traits = sorts_[i]->traits();
        const Series& series = series_[i];
        SortRow row;
        row.input = input, row.size = size.empty() ? size_name(pairs) : size, row.pairs = pairs;
        row.sort = traits.name, row.backend = traits.backend, row.key_bits = traits.key_bits;
        row.passes = traits.network ? passes_ : 0;
        row.frames = series.sort_ms.size();
        row.median_ms = measure::quantile(series.sort_ms, 0.5);
        row.p95_ms = measure::quantile(series.sort_ms, 0.95);
        row.floor_ms = measure::quantile(series.floor_ms, 0.5);
        row.bytes_per_pair = traits.bytes_per_pair(pairs, passes_);
        row.share_under_10_ms = share_below(series.sort_ms, kReportsLimit_ms);
        row.inversions = mean(series.inversions);
        if (!series.image_errors.empty())
        {
            row.image_error = mean(series.image_errors);
            row.worst_image_error = std::ranges::max(series.image_errors);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string size_name(std::size_t n)
{
    if (n >= 1'000'000 && n % 1'000'000 == 0) return fmt::format("{}M", n / 1'000'000);
    if (n >= 1000 && n % 1000 == 0) return fmt::format("{}K", n / 1000);
    return fmt::format("{}", n);
}

}  // namespace spindrift::app
