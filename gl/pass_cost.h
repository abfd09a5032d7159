// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "core/view.h"
#include "gl/frame_plan.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// What a pass of that name touches in a frame of that size.
PassCost pass_cost(std::string_view pass, const scene::Scene& scene, const View& view,
                   const FrameStats& last);

}  // namespace spindrift::gl
