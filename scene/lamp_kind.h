// SPDX-License-Identifier: MIT
#pragma once

#include "core/light.h"
#include "scene/scene.h"

namespace spindrift::scene
{

/// What the kind of a light in a scene file is called in core/.
constexpr LampKind lamp_kind(LightKind kind)
{
    switch (kind)
    {
        case LightKind::spot:
            return LampKind::spot;
        case LightKind::directional:
            return LampKind::directional;
        case LightKind::point:
            break;
    }
    return LampKind::point;
}

}  // namespace spindrift::scene
