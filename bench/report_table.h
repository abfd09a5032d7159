// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace spindrift::bench
{

/// The report's Table 4.1 (seconds to sort) beside our rows sort/random/SIZE/qsort and /radix from Google
/// Benchmark's JSON, as Markdown. Throws Error for a file that cannot be read or lacks those rows.
std::string report_table(const std::string& benchmark_json);

}  // namespace spindrift::bench
