// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/light.h"
#include "core/shadow.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// A box along the axes, m, local frame. Empty: low above high.
struct CasterBox
{
    Vec3f low, high;
    bool empty() const { return low.x > high.x; }
};

/// What a level mesh at the bottom of all covers, it hides from nobody.
bool casts_shadow(const scene::Mesh& mesh, float lowest_m);
float lowest_of(const scene::Geometry& geometry);

/// All that casts shadows in the domain, wherever its vehicles go: it does not change over a run. The domain
/// itself where nothing does.
CasterBox casters_of(const scene::Scene& scene, const scene::Geometry& geometry);

/// The lens of a lamp's map of `px` texels across over what is in the box; depth over the width.
LampLens map_lens(const Lamp<float>& lamp, const CasterBox& box, int px);
/// The same for the slices of the snow in a box; depth linear along the way of the light, by itself.
LampLens snow_lens(const Lamp<float>& lamp, const CasterBox& box, int px);

/// What a shadow map depends on: while none of it changes, the map holds.
struct ShadowCast
{
    std::vector<Lamp<float>> lamps;  ///< those with maps
    std::vector<Vec3f> vehicles;     ///< where models stand that move
    bool operator==(const ShadowCast& other) const;
};

/// Of the lamps of a frame, casters first, at its display time.
ShadowCast shadow_cast(const scene::Scene& scene, const std::vector<Lamp<float>>& lamps, double time_s);

}  // namespace spindrift::gl
