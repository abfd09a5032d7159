// SPDX-License-Identifier: MIT
#include <string>

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

int main(int argc, char** argv)
{
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::AddCustomContext("threads", std::to_string(tbb::this_task_arena::max_concurrency()));
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
