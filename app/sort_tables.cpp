// SPDX-License-Identifier: MIT
#include "app/sort_tables.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/build_info.h"
#include "app/machine.h"

namespace spindrift::app
{

namespace
{

using Json = nlohmann::ordered_json;

std::string number_or_dash(double value)
{
    return value == 0 ? "-" : fmt::format("{:.0f}", value);
}

std::string error_text(const std::optional<double>& error)
{
    if (!error) return "-";
    return *error == 0 ? "0" : fmt::format("{:.1e}", *error);
}

struct ReportRow  // seconds
{
    std::size_t pairs;
    double cpu_quick_sort, gpu_with_passes, gpu_without_passes;
};

constexpr std::array kReport{
    ReportRow{15'000, 0.017, 0.000168, 0.002295},    ReportRow{65'000, 0.072, 0.000237, 0.003283},
    ReportRow{250'000, 0.335, 0.000296, 0.004891},   ReportRow{500'000, 0.741, 0.000562, 0.008573},
    ReportRow{1'000'000, 1.533, 0.000745, 0.012487}, ReportRow{2'000'000, 3.35, 0.000968, 0.017319},
};

/// A column of the table: the report's own figures, or a sort of ours.
struct Column
{
    std::string_view title;
    double ReportRow::*report = nullptr;
    std::string_view ours = {};
};

constexpr std::array kColumns{
    Column{"Report: quick sort, CPU", &ReportRow::cpu_quick_sort},
    Column{"Ours: qsort, CPU", nullptr, "qsort"},
    Column{"Report: GPU, with passes", &ReportRow::gpu_with_passes},
    Column{"Ours: passes, CPU", nullptr, "bitonic-passes"},
    Column{"Ours: passes, CUDA", nullptr, "cuda/bitonic-passes"},
    Column{"Report: GPU, without passes", &ReportRow::gpu_without_passes},
    Column{"Ours: bitonic, CUDA", nullptr, "cuda/bitonic"},
    Column{"Ours: radix, CPU", nullptr, "radix"},
    Column{"Ours: cub-radix, CUDA", nullptr, "cuda/cub-radix"},
};

const SortRow* find(std::span<const SortRow> rows, std::string_view sort, std::size_t pairs)
{
    const auto found =
        std::ranges::find_if(rows, [&](const SortRow& row)
                             { return row.input == "random" && row.sort == sort && row.pairs == pairs; });
    return found == rows.end() ? nullptr : &*found;
}

}  // namespace

std::string to_text(std::span<const SortRow> rows)
{
    std::string text;
    std::string block;
    for (const SortRow& row : rows)
    {
        const std::string head = fmt::format("{}, {} pairs, {} frames", row.input, row.size, row.frames);
        if (head != block)
            text += fmt::format("{}{}\n  {:<24}{:>10}{:>9}{:>8}{:>12}{:>13}{:>13}\n",
                                block.empty() ? "" : "\n", head, "sort", "ms", "x floor", "B/pair",
                                "inversions", "image error", "under 0.01 s");
        block = head;
        text +=
            fmt::format("  {:<24}{:>10.3f}{:>9.2f}{:>8}{:>12}{:>13}{:>12.0f}%\n", row.sort, row.median_ms,
                        row.median_ms / row.floor_ms, number_or_dash(row.bytes_per_pair),
                        error_text(row.inversions), error_text(row.image_error), 100 * row.share_under_10_ms);
    }
    return text;
}

std::string to_csv(std::span<const SortRow> rows)
{
    const auto optional = [](const std::optional<double>& value)
    { return value ? fmt::format("{}", *value) : std::string(); };
    std::string text =
        "input,pairs,sort,backend,key_bits,passes_per_frame,frames,median_ms,p95_ms,floor_ms,x_floor,bytes_"
        "per_pair,"
        "inversion_fraction,image_relative_l2,image_relative_l2_worst,share_under_0.01_s\n";
    for (const SortRow& row : rows)
        text +=
            fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", row.input, row.pairs, row.sort,
                        row.backend, row.key_bits, row.passes, row.frames, row.median_ms, row.p95_ms,
                        row.floor_ms, row.median_ms / row.floor_ms, row.bytes_per_pair, row.inversions,
                        optional(row.image_error), optional(row.worst_image_error), row.share_under_10_ms);
    return text;
}

std::string to_json(std::span<const SortRow> rows, const std::string& pictures_by)
{
    const auto optional = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
    Json list = Json::array();
    for (const SortRow& row : rows)
        list.push_back({{"input", row.input},
                        {"pairs", row.pairs},
                        {"sort", row.sort},
                        {"backend", row.backend},
                        {"key_bits", row.key_bits},
                        {"passes_per_frame", row.passes == 0 ? Json() : Json(row.passes)},
                        {"frames", row.frames},
                        {"median_ms", row.median_ms},
                        {"p95_ms", row.p95_ms},
                        {"floor_ms", row.floor_ms},
                        {"x_floor", row.median_ms / row.floor_ms},
                        {"bytes_per_pair", row.bytes_per_pair},
                        {"inversion_fraction", row.inversions},
                        {"image_relative_l2", optional(row.image_error)},
                        {"image_relative_l2_worst", optional(row.worst_image_error)},
                        {"share_under_0.01_s", row.share_under_10_ms}});
    const std::string no_cuda = measure::no_cuda_because();
    const Json json = {{"spindrift", {{"version", kVersion}, {"build", kBuildType}, {"compiler", kCompiler}}},
                       {"machine",
                        {{"processor", processor_name()},
                         {"threads", usable_threads({})},
                         {"cuda", no_cuda.empty() ? "yes" : "none: " + no_cuda}}},
                       {"pictures_by", pictures_by},
                       {"rows", list}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::string> table_4_1_strategies()
{
    return {"qsort", "radix", "bitonic-passes", "bitonic", "cub-radix"};
}

std::string table_4_1(std::span<const SortRow> rows)
{
    std::vector<Column> columns;
    for (const Column& column : kColumns)
        if (column.report != nullptr || find(rows, column.ours, kTable41Sizes[0]) != nullptr)
            columns.push_back(column);
    std::string text = "| Pairs |";
    std::string rule = "|---:|";
    for (const Column& column : columns)
    {
        text += fmt::format(" {} (s) |", column.title);
        rule += "---:|";
    }
    text += "\n" + rule + "\n";
    for (const ReportRow& report : kReport)
    {
        text += fmt::format("| {} |", size_name(report.pairs));
        for (const Column& column : columns)
        {
            const SortRow* const row = find(rows, column.ours, report.pairs);
            if (column.report != nullptr)
                text += fmt::format(" {:.6f} |", report.*column.report);
            else
                text += row == nullptr ? " - |" : fmt::format(" {:.6f} |", row->median_ms * 1e-3);
        }
        text += "\n";
    }
    return text;
}

}  // namespace spindrift::app
