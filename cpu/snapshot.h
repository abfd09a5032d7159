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

/// Throws Error unless the arrays of a snapshot are whole, fit the capacity, and hold finite, living flakes
/// of emitters that exist.
void check_arrays(const Snapshot& snapshot, std::uint64_t capacity, std::size_t emitters);

/// Writes the arrays of a checked snapshot to the slots from 0 on.
void put_arrays(const Snapshot& snapshot, const FlakeView& flakes);

/// Sum of flake_hash over the living flakes of the slots [first, last).
std::uint64_t flakes_hash(const FlakeView& flakes, std::size_t first, std::size_t last);

}  // namespace spindrift::cpu
