// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/flake.h"
#include "core/view.h"
#include "core/world.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::golden
{

/// Flakes that stand still, in memory of their own.
struct StillFlakes
{
    std::vector<float> x, y, z;
    std::vector<std::uint32_t> id, state;

    void add(const Vec3f& position_m, std::uint32_t serial);
    /// The turbulence and slip arrays are null: drawing reads neither.
    FlakeView view();
};

/// A scene put together in code, all in the local frame, so that drawing is tested without file, physics or
/// sort.
struct SmallScene
{
    scene::Scene scene;
    scene::Geometry geometry;
    World world;
    View view;
    StillFlakes flakes;
    double time_s = 0;
};

/// 160x120, sky only, no ground, no light but the ambient one, no flakes.
SmallScene empty_scene();

/// Ground at 0, in the colour of the scene's settings.
void add_ground(SmallScene& small);

/// Ground, a wall that hides a part of the flakes, `count` flakes over a field from 1 m to 30 m away.
SmallScene flakes_by_a_wall(int count);

/// The same with flakes that are `enlargement` times as large and so many times as few.
void enlarge(SmallScene& small, double enlargement);

/// Adds a lamp of each kind, one of them behind the flakes and one flashing.
void light_up(SmallScene& small);

/// Fills the air: a sky in which the eye stands, drift, and lamps of all kinds of phase function.
void thicken(SmallScene& small);

}  // namespace spindrift::golden
