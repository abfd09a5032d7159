// SPDX-License-Identifier: MIT
#include "cpu/sort/strategy.h"

namespace spindrift::cpu::sorts
{

SortStrategy none()
{
    return {.name = "none",
            .about = "no sort: flakes are drawn in the order of their emission",
            .sort = nullptr,
            .max_key_bits = 32,
            .bytes_moved_per_pair_32 = 0};
}

}  // namespace spindrift::cpu::sorts
