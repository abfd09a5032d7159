// SPDX-License-Identifier: MIT
#include "reference/shadows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/shadow.h"
#include "core/snow.h"
#include "core/sprite.h"
#include "scene/crystals.h"

namespace spindrift::reference
{

namespace
{

Vec3d unit(const Vec3d& v)
{
    return v * (1 / std::sqrt(dot(v, v)));
}

bool alive(const FlakeView& flakes, std::size_t slot)
{
    return (flakes.state[slot] & 0xFFU) == static_cast<std::uint32_t>(Fate::alive);
}

}  // namespace

SnowShade::SnowShade(const scene::Scene& scene, const World& world, const FlakeView& flakes, std::size_t used,
                     const Lamp<double>& lamp)
    : lamp_(lamp),
      right_(unit(cross(lamp.direction, std::abs(lamp.direction.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0}))),
      up_(cross(right_, lamp.direction)),
      real_flakes_(world.snow.weight / (scene.render.flake_scale * scene.render.flake_scale)),
      solid_(scene.render.blending == scene::Blending::opaque),
      plain_(scene.render.sprite == scene::Sprite::point),
      cells_(kCells * kCells)
{
    const FlakeSizes sizes(world.snow, world.seed);
    constexpr double most = std::numeric_limits<double>::max();
    double high_x = -most, high_y = -most;
    low_x_ = low_y_ = most;
    for (std::size_t slot = 0; slot < used; ++slot)
    {
        const Seen at = seen_from_lamp({flakes.x[slot], flakes.y[slot], flakes.z[slot]});
        if (!alive(flakes, slot) || at.width <= 0) continue;
        const double radius_m = 0.5 * sizes.diameter_m<double>(flakes.id[slot]) * scene.render.flake_scale;
        const FlakeTurn turn = flake_turn(world.seed, flakes.id[slot], scene::kCrystalShapes);
        const double whole =
            plain_ ? 1 : scene.render.flake_opacity * scene::crystal_masks()[turn.shape].mean;
        const Disc disc{at.x, at.y, at.depth, radius_m / at.width, whole};
        discs_.push_back(disc);
        low_x_ = std::min(low_x_, disc.x - disc.radius);
        low_y_ = std::min(low_y_, disc.y - disc.radius);
        high_x = std::max(high_x, disc.x + disc.radius);
        high_y = std::max(high_y, disc.y + disc.radius);
    }
    size_x_ = std::max(high_x - low_x_, 1e-9);
    size_y_ = std::max(high_y - low_y_, 1e-9);
    for (std::uint32_t i = 0; i < discs_.size(); ++i)
    {
        const Disc& disc = discs_[i];
        for (std::size_t y = cell_of(disc.y - disc.radius, low_y_, size_y_);
             y <= cell_of(disc.y + disc.radius, low_y_, size_y_); ++y)
            for (std::size_t x = cell_of(disc.x - disc.radius, low_x_, size_x_);
                 x <= cell_of(disc.x + disc.radius, low_x_, size_x_); ++x)
                cells_[y * kCells + x].push_back(i);
    }
}

SnowShade::Seen SnowShade::seen_from_lamp(const Vec3d& place) const
{
    const bool parallel = lamp_.kind == LampKind::directional;
    const Vec3d from = parallel ? place : place - lamp_.position_m;
    const double depth = dot(from, lamp_.direction), width = parallel ? 1 : depth;
    return {dot(from, right_) / width, dot(from, up_) / width, depth, width};
}

std::size_t SnowShade::cell_of(double at, double low, double size) const
{
    const double cell = std::floor((at - low) / size * static_cast<double>(kCells));
    return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(kCells - 1)));
}

double SnowShade::share_at(const Vec3d& place) const
{
    const Seen at = seen_from_lamp(place);
    if (discs_.empty() || at.width <= 0 || at.x < low_x_ || at.x > low_x_ + size_x_ || at.y < low_y_ ||
        at.y > low_y_ + size_y_)
        return 1;
    double share = 1;
    for (const std::uint32_t i :
         cells_[cell_of(at.y, low_y_, size_y_) * kCells + cell_of(at.x, low_x_, size_x_)])
    {
        const Disc& disc = discs_[i];
        const double x = (at.x - disc.x) / disc.radius, y = (at.y - disc.y) / disc.radius;
        const double rho2 = x * x + y * y;
        if (disc.depth >= at.depth || rho2 > 1) continue;
        if (solid_) return 0;
        const double opacity = disc.whole * (plain_ ? 1 : sprite_profile(rho2));
        share *= 1 - weighted_opacity(opacity, real_flakes_);
    }
    return share;
}

Shadows::Shadows(const scene::Scene& scene, const World& world, const FlakeView& flakes, std::size_t used,
                 const RayScene& solids, const std::vector<Lamp<double>>& lamps, bool in_fog)
    : solids_(solids), lamps_(lamps), snow_(lamps.size())
{
    if (scene.shadows.snow_slices == 0 || scene.render.blending == scene::Blending::additive) return;
    for (std::size_t i = 0; i < lamps.size(); ++i)
        if (lamps[i].casts_shadow && !(in_fog && lamps[i].kind == LampKind::spot))
            snow_[i].emplace_back(scene, world, flakes, used, lamps[i]);
}

double Shadows::share(std::size_t lamp, const Vec3d& place) const
{
    const Lamp<double>& from = lamps_[lamp];
    if (!from.casts_shadow) return 1;
    Vec3d way = from.direction * -1.0;
    double to = std::numeric_limits<double>::infinity();
    if (from.kind == LampKind::spot)
    {
        way = from.position_m - place;
        const double depth = -dot(way, from.direction);
        if (depth <= kShadowNearest_m) return 1;
        to = 1 - kShadowNearest_m / depth;  // the lamp's own housing casts none
    }
    Hit hit;
    if (solids_.first_hit(place, way, 0, to, hit)) return 0;
    return snow_[lamp].empty() ? 1 : snow_[lamp].front().share_at(place);
}

}  // namespace spindrift::reference
