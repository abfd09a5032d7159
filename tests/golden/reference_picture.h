// SPDX-License-Identifier: MIT
#pragma once

#include "reference/reference.h"
#include "tests/golden/small_scenes.h"

namespace spindrift::golden
{

/// What the reference renderer makes of a small scene.
inline image::Image reference_picture(SmallScene& small)
{
    return reference::render(small.scene, small.geometry, small.world, small.flakes.view(),
                             small.flakes.x.size(), small.view, small.time_s);
}

}  // namespace spindrift::golden
