// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/flake.h"
#include "core/streak.h"
#include "core/view.h"
#include "core/world.h"
#include "reference/shading.h"
#include "scene/crystals.h"
#include "scene/scene.h"

namespace spindrift::reference
{

/// One flake as it stands on the picture.
struct Sprite
{
    double distance2 = 0;  ///< to the eye, m², the order of drawing
    std::uint32_t id = 0;  ///< orders equal distances
    double x = 0, y = 0;   ///< projected centre, px from the upper left corner of the picture
    double z = 0;          ///< depth along the view, m
    double r = 0;          ///< px, as drawn
    double radius_m = 0;
    double opacity = 0;           ///< what its smallness and nearness leave, before profile and weight
    double cosine = 1, sine = 0;  ///< of its angle
    int shape = 0;
    Streak<double> streak;  ///< half = 0: stands still
    FlakeLight light;
    AirView air;  ///< before the flake
};

/// Every alive flake that can touch the picture, far to near.
std::vector<Sprite> make_sprites(const scene::Scene& scene, const World& world, const FlakeView& flakes,
                                 std::size_t used, const View& view, const scene::Air& air,
                                 const Lighting& lighting, double time_s);

/// What a sprite does to one pixel.
struct Dab
{
    double alpha = 0;
    Rgb colour{};
};

/// The dab of a sprite at a pixel centre (px from the upper left corner) whose scene lies at depth `z_scene`.
Dab dab_at(const Sprite& sprite, const scene::Scene& scene, const World& world,
           const std::vector<scene::CrystalMask>& crystals, double pixel_x, double pixel_y, double z_scene);

}  // namespace spindrift::reference
