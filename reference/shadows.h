// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/flake.h"
#include "core/light.h"
#include "core/world.h"
#include "reference/ray_scene.h"
#include "scene/scene.h"

namespace spindrift::reference
{

/// What of a lamp's light gets past the drawn flakes: exactly, each one a disc that faces the light.
class SnowShade
{
  public:
    SnowShade(const scene::Scene& scene, const World& world, const FlakeView& flakes, std::size_t used,
              const Lamp<double>& lamp);
    double share_at(const Vec3d& place) const;

  private:
    /// On a plane across the light: parallel light's as they are, a spot's over their depth.
    struct Disc
    {
        double x, y, depth, radius;
        double whole;  ///< opacity at the centre, before the weight
    };
    struct Seen
    {
        double x, y, depth, width;
    };
    Seen seen_from_lamp(const Vec3d& place) const;
    std::size_t cell_of(double at, double low, double size) const;

    static constexpr std::size_t kCells = 256;  ///< a side
    Lamp<double> lamp_;
    Vec3d right_, up_;
    double real_flakes_, low_x_, low_y_, size_x_, size_y_;
    bool solid_;  ///< opaque points
    bool plain_;  ///< no profile
    std::vector<Disc> discs_;
    std::vector<std::vector<std::uint32_t>> cells_;
};

/// Share of each lamp's light that reaches a place past solids and flakes.
class Shadows
{
  public:
    /// `lamps` and `solids` must outlive it. Flakes dim spots only where `in_fog` is false: there the
    /// extinction of the air stands for them.
    Shadows(const scene::Scene& scene, const World& world, const FlakeView& flakes, std::size_t used,
            const RayScene& solids, const std::vector<Lamp<double>>& lamps, bool in_fog);

    double share(std::size_t lamp, const Vec3d& place) const;

  private:
    const RayScene& solids_;
    const std::vector<Lamp<double>>& lamps_;
    std::vector<std::vector<SnowShade>> snow_;  ///< by lamp: none or one
};

}  // namespace spindrift::reference
