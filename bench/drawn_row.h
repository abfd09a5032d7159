// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>

#include <exception>
#include <string>

namespace spindrift::bench
{

/// Registers a row that measures by itself, in ms, and reports what it throws.
template <class Body>
void add_drawn_row(const std::string& name, const Body& body)
{
    benchmark::RegisterBenchmark(name.c_str(),
                                 [body](benchmark::State& state)
                                 {
                                     try
                                     {
                                         body(state);
                                     }
                                     catch (const std::exception& error)
                                     {
                                         state.SkipWithError(error.what());
                                     }
                                 })
        ->UseManualTime()
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
}

}  // namespace spindrift::bench
