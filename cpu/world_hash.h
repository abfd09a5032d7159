// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/world.h"

namespace spindrift::cpu
{

/// Of every value of a World that its flakes depend on: a snapshot fits only the World that it was made in.
std::uint64_t world_hash(const World& world);

}  // namespace spindrift::cpu
