// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/depth_key.h"
#include "cuda/flake_memory.h"
#include "cuda/selection.h"
#include "cuda/step_control.h"

namespace spindrift::gpu
{

/// Fills the draw list's pairs with those that a frustum sees, in slot order, and StepControl::visible.
void list_visible(StreamRef stream, StepControl* control, std::size_t capacity, const FlakeAddresses& at,
                  const Frustum& frustum, const Selection& selection);

/// Puts flakes of equal keys in order of emission, after a sort of n pairs.
void order_ties(StreamRef stream, std::uint64_t* pairs, std::size_t n, const std::uint32_t* id,
                std::uint32_t next_id);

}  // namespace spindrift::gpu
