// SPDX-License-Identifier: MIT
#include "bench/report_table.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace spindrift::bench
{

namespace
{

struct ReportRow  // seconds
{
    std::string_view size;
    double cpu_quick_sort;
    double gpu_with_passes;
    double gpu_without_passes;
};

constexpr std::array kReport{
    ReportRow{"15K", 0.017, 0.000168, 0.002295},  ReportRow{"65K", 0.072, 0.000237, 0.003283},
    ReportRow{"250K", 0.335, 0.000296, 0.004891}, ReportRow{"500K", 0.741, 0.000562, 0.008573},
    ReportRow{"1M", 1.533, 0.000745, 0.012487},   ReportRow{"2M", 3.35, 0.000968, 0.017319},
};

// Seconds by row name without the suffixes that Google Benchmark adds.
std::map<std::string, double> measured_seconds(const std::string& file)
{
    std::ifstream stream(file);
    if (!stream) throw Error(file + ": cannot be read; write it with --benchmark_out=" + file);
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    if (json.is_discarded() || !json.contains("benchmarks") || !json["benchmarks"].is_array())
        throw Error(file +
                    ": is not the JSON of Google Benchmark; write it with --benchmark_out_format=json");
    std::map<std::string, double> seconds;
    for (const auto& row : json["benchmarks"])
    {
        std::string name = row.value("name", "");
        name.resize(std::min(name.size(), name.find("/iterations:")));
        if (row.value("time_unit", "") == "ms") seconds[name] = row.value("real_time", 0.0) * 1e-3;
    }
    return seconds;
}

double seconds_of(const std::map<std::string, double>& seconds, std::string_view size,
                  std::string_view strategy, const std::string& file)
{
    const auto found = seconds.find(fmt::format("sort/random/{}/{}", size, strategy));
    if (found == seconds.end())
        throw Error(fmt::format("{}: has no row sort/random/{}/{}; use --benchmark_filter='^sort/random/'",
                                file, size, strategy));
    return found->second;
}

}  // namespace

std::string report_table(const std::string& benchmark_json)
{
    const auto seconds = measured_seconds(benchmark_json);
    std::string table =
        "| Pairs | Report: quick sort, CPU (s) | Ours: qsort (s) | Report: GPU, with passes (s) "
        "| Report: GPU, without passes (s) | Ours: radix, CPU (s) | qsort / radix, ours |\n"
        "|---:|---:|---:|---:|---:|---:|---:|\n";
    for (const ReportRow& row : kReport)
    {
        const double qsort_s = seconds_of(seconds, row.size, "qsort", benchmark_json);
        const double radix_s = seconds_of(seconds, row.size, "radix", benchmark_json);
        table += fmt::format("| {} | {:.3f} | {:.6f} | {:.6f} | {:.6f} | {:.6f} | {:.0f} |\n", row.size,
                             row.cpu_quick_sort, qsort_s, row.gpu_with_passes, row.gpu_without_passes,
                             radix_s, qsort_s / radix_s);
    }
    return table;
}

}  // namespace spindrift::bench
