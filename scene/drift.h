// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/world.h"

namespace spindrift::scene
{

/// Completes a drift emitter (its box in the local frame) from the wind of the world, which is whole but for
/// emitters: how much snow the wind takes up there, as cross-section in drawn flakes, and how high it leaps
/// and hangs. Returns the law of its grains. Where the friction velocity is nowhere above `threshold_m_s`
/// nothing is made, at the start neither. Throws Error where it does not stand on plane ground, or the wind
/// is not one that has a friction velocity; `number` names it there.
GrainLaw set_drift(const World& world, double threshold_m_s, std::size_t number, Emitter& emitter);

}  // namespace spindrift::scene
