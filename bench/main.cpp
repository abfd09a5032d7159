// SPDX-License-Identifier: MIT
#include <cstdio>
#include <string>
#include <string_view>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include "bench/report_table.h"
#include "core/error.h"

// spindrift-bench [--benchmark_...]    measures
// spindrift-bench --table FILE.json    prints the report's Table 4.1 beside the figures in FILE.json
int main(int argc, char** argv)
{
    if (argc == 3 && std::string_view(argv[1]) == "--table")
    {
        try
        {
            fmt::print("{}", spindrift::bench::report_table(argv[2]));
            return 0;
        }
        catch (const spindrift::Error& error)
        {
            fmt::print(stderr, "{}\n", error.what());
            return 2;
        }
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::AddCustomContext("threads", std::to_string(tbb::this_task_arena::max_concurrency()));
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
