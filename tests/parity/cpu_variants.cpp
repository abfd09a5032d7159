// SPDX-License-Identifier: MIT
#include "tests/parity/backends.h"

namespace spindrift::parity
{

std::vector<Variant> variants()
{
    const auto variant = [](const char* name, int threads, std::uint32_t reorder) {
        return Variant{name, [=](const World& world) { return make_cpu_run(world, threads, reorder); },
                       reorder};
    };
    return {variant("TwoThreads", 2, 0), variant("ReorderedEachStep", 2, 1),
            variant("ReorderedEverySevenSteps", 1, 7)};
}

std::string cannot_run_because()
{
    return {};
}

}  // namespace spindrift::parity
