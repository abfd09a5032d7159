// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/backend.h"

namespace spindrift::cpu
{

/// The eleven arrays as bits, without holes.
std::vector<std::vector<std::uint32_t>> alive_arrays(const FlakeView& flakes, std::size_t used);

/// Writes the arrays of a checked snapshot to the slots from 0 on.
void put_arrays(const Snapshot& snapshot, const FlakeView& flakes);

}  // namespace spindrift::cpu
