// SPDX-License-Identifier: MIT
#include "reference/sprites.h"

#include <algorithm>
#include <cmath>

#include "core/flake_motion.h"
#include "core/snow.h"
#include "core/sprite.h"

namespace spindrift::reference
{

namespace
{

/// Radius as drawn, and the opacity that keeps the coverage of flakes below the smallest radius.
void set_size(Sprite& sprite, const scene::RenderSettings& render, const View& view, double diameter_m)
{
    const double focal_px = view.height_px / (2.0 * view.tan_half_fov_y);
    const double largest_px = std::min<double>(view.guard_px, kLargestSprite_px);
    sprite.radius_m = 0.5 * diameter_m * render.flake_scale;
    const SpriteSize<double> size =
        sprite_size<double>(sprite.radius_m, sprite.z, focal_px, largest_px, view.near_m);
    sprite.r = size.radius_px;
    sprite.opacity = size.opacity;
}

/// Its way on the picture while the shutter is open; without the share of the plain disc.
void set_streak(Sprite& sprite, const scene::RenderSettings& render, const View& view, const Vec3d& from_eye,
                const Vec3d& velocity)
{
    const auto seen = [&](const Vec3d& v) {
        return Vec3d{dot(v, wide(view.right)), dot(v, wide(view.up)), dot(v, wide(view.forward))};
    };
    const double focal_px = view.height_px / (2.0 * view.tan_half_fov_y);
    double x_px = 0, y_px = 0;
    streak_way(seen(from_eye), seen(velocity), focal_px / sprite.z, render.shutter_s, x_px, y_px);
    sprite.streak = streak_of(x_px, y_px, sprite.r, std::min<double>(view.guard_px, kLargestSprite_px));
}

/// Sprite in the colour of its flake: crystal sprites that are lit and large enough are shaded as spheres.
Rgb radiance(const Sprite& sprite, const scene::RenderSettings& render, double px, double py)
{
    double shade = 1;
    if (render.blending != scene::Blending::opaque && render.sprite == scene::Sprite::crystal)
        shade =
            imposter(px, py, sprite.light.towards, sprite_detail(sprite.r) * streak_detail(sprite.streak));
    const Rgb sum = sprite.light.ambient + sprite.light.lamps * shade;
    const Rgb own{std::min(sum.x, kMostRadiance), std::min(sum.y, kMostRadiance),
                  std::min(sum.z, kMostRadiance)};
    return own * sprite.air.clear + sprite.air.glow;
}

/// Of the air before a flake `d` away. Beyond the flakes' volume alone begins the report's fog.
AirView flake_air(const scene::Scene& scene, const scene::Air& air, const Lighting& lighting,
                  const View& view, const Vec3d& d)
{
    if (air.law == scene::FogLaw::legacy) return {};
    const double distance_m = std::sqrt(dot(d, d));
    AirView seen = air_before(scene, air, lighting, view, d * (1 / distance_m), distance_m);
    // What is added covers nothing: the fog before it is in the picture already.
    if (scene.render.blending == scene::Blending::additive) seen.glow = {0, 0, 0};
    return seen;
}

}  // namespace

std::vector<Sprite> make_sprites(const scene::Scene& scene, const World& world, const FlakeView& flakes,
                                 std::size_t used, const View& view, const scene::Air& air,
                                 const Lighting& lighting, double time_s)
{
    const Vec3d eye = wide(view.eye), right = wide(view.right), up = wide(view.up),
                forward = wide(view.forward);
    const double focal_px = view.height_px / (2.0 * view.tan_half_fov_y);
    const FlakeSizes sizes(world.snow, world.seed);
    const FlakeMotion motion(world);
    std::vector<Sprite> sprites;
    for (std::size_t slot = 0; slot < used; ++slot)
    {
        if ((flakes.state[slot] & 0xFFU) != static_cast<std::uint32_t>(Fate::alive)) continue;
        const Vec3d at{flakes.x[slot], flakes.y[slot], flakes.z[slot]};
        const Vec3d d = at - eye;
        Sprite sprite;
        sprite.z = dot(d, forward);
        if (!(sprite.z > view.near_m && sprite.z < view.far_m)) continue;
        sprite.distance2 = dot(d, d);
        sprite.id = flakes.id[slot];
        sprite.x = 0.5 * view.width_px + dot(d, right) / sprite.z * focal_px;
        sprite.y = 0.5 * view.height_px - dot(d, up) / sprite.z * focal_px;
        set_size(sprite, scene.render, view, sizes.diameter_m<double>(sprite.id));
        if (air.tiny_flakes_fade && scene.render.blending != scene::Blending::opaque)
            sprite.opacity *= kept_of_tiny(2 * sprite.radius_m * focal_px / sprite.z);
        if (scene.render.shutter_s > 0)
            set_streak(sprite, scene.render, view, d, wide(motion.velocity(flakes, slot)));
        const double reach = sprite.r * (1 + sprite.streak.half);
        if (sprite.x < -reach || sprite.y < -reach || sprite.x > view.width_px + reach ||
            sprite.y > view.height_px + reach)
            continue;
        const FlakeTurn turn = flake_turn(world.seed, sprite.id, scene::kCrystalShapes);
        sprite.shape = static_cast<int>(turn.shape);
        sincos_turns(turn.turns_at(time_s), sprite.sine, sprite.cosine);
        sprite.light = flake_light(lighting, view, at);
        sprite.air = flake_air(scene, air, lighting, view, d);
        sprites.push_back(sprite);
    }
    std::sort(sprites.begin(), sprites.end(),
              [](const Sprite& a, const Sprite& b)
              { return a.distance2 != b.distance2 ? a.distance2 > b.distance2 : a.id < b.id; });
    return sprites;
}

Dab dab_at(const Sprite& sprite, const scene::Scene& scene, const World& world,
           const std::vector<scene::CrystalMask>& crystals, double pixel_x, double pixel_y, double z_scene)
{
    const scene::RenderSettings& render = scene.render;
    const double px = (pixel_x - sprite.x) / sprite.r;
    const double py = (sprite.y - pixel_y) / sprite.r;
    const double rho2 = px * px + py * py;
    const bool moves = sprite.streak.half > 0;
    if ((!moves && rho2 > 1) || sprite.z >= z_scene) return {};
    const Rgb colour = radiance(sprite, render, px, py);
    if (render.blending == scene::Blending::opaque) return {1, colour};

    double profile = 1, mask = 1, mean = 1;
    if (render.sprite == scene::Sprite::crystal)
    {
        const scene::CrystalMask& crystal = crystals[static_cast<std::size_t>(sprite.shape)];
        const double t = sprite_detail(sprite.r) * streak_detail(sprite.streak);
        mask = mean = crystal.mean;
        if (t > 0)
        {
            const double u = sprite.cosine * px + sprite.sine * py, v = sprite.cosine * py - sprite.sine * px;
            mask += t * (scene::sample_mask(crystal, u, v, std::max(0.0, std::log2(64 / sprite.r))) -
                         crystal.mean);
        }
        profile = render.flake_opacity;
    }
    const double real_flakes = world.snow.weight / (render.flake_scale * render.flake_scale);
    double alpha = 0;
    if (moves)
    {
        const double opacity = sprite.opacity * profile * mean;
        Streak<double> streak = sprite.streak;
        streak.even = even_share(opacity, real_flakes);
        const bool discs = render.sprite == scene::Sprite::point;
        alpha = weighted_opacity(opacity, real_flakes) * streak_profile(streak, px, py, discs) * mask / mean;
        alpha = std::min(alpha, 1.0);
    }
    else
    {
        if (render.sprite == scene::Sprite::crystal) profile *= sprite_profile(rho2) * mask;
        alpha = weighted_opacity(sprite.opacity * profile, real_flakes);
    }
    return {alpha * soft_edge(z_scene, sprite.z, 1 / std::max(sprite.radius_m, kThinnestFade_m)), colour};
}

}  // namespace spindrift::reference
