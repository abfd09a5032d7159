// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/world.h"

namespace spindrift::bench
{

/// What advection is measured in: flakes spread at random over a wind grid of 128 x 128 x 64 cells (64 MB),
/// all emitted in the first step; they wrap and meet nothing.
World windy_box(std::uint64_t flakes, bool turbulent);

/// The same flakes in the logarithmic profile of a surface layer, of which there is nothing to read.
World profile_box(std::uint64_t flakes, bool turbulent);

}  // namespace spindrift::bench
