// SPDX-License-Identifier: MIT
#include "reference/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "reference/ray_scene.h"
#include "reference/shading.h"
#include "reference/sprites.h"

namespace spindrift::reference
{

namespace
{

/// Scene and sky of one pixel, on which the flakes are drawn.
struct Canvas
{
    Rgb colour{};
    double z = 0;  ///< depth of the scene along the view, m; infinite where there is only sky
};

/// Everything of a frame that its rows share.
struct Frame
{
    const scene::Scene& scene;
    const World& world;
    const View& view;
    const RayScene& solids;
    const scene::Air& air;
    const Lighting& lighting;
    const std::vector<scene::CrystalMask>& crystals;
    const std::vector<Sprite>& sprites;
};

Rgb sky_radiance(const scene::SkySettings& sky, const Vec3d& direction)
{
    const double up = std::sqrt(std::max(direction.z / std::sqrt(dot(direction, direction)), 0.0));
    return rgb(sky.horizon) * (1 - up) + rgb(sky.zenith) * up;
}

Canvas empty_canvas(const Frame& frame, int x, int y)
{
    const View& view = frame.view;
    const double focal_px = view.height_px / (2.0 * view.tan_half_fov_y);
    // Its length along the view is 1, so that ray parameters are depths.
    const Vec3d direction = wide(view.forward) +
                            wide(view.right) * ((x + 0.5 - 0.5 * view.width_px) / focal_px) +
                            wide(view.up) * ((0.5 * view.height_px - y - 0.5) / focal_px);
    const Vec3d eye = wide(view.eye);
    Hit hit;
    const bool met = frame.solids.first_hit(eye, direction, view.near_m, view.far_m, hit);
    const double length = std::sqrt(dot(direction, direction));
    const Vec3d way = direction * (1 / length);
    // The air ends at the far plane.
    const double depth_m = met ? hit.along : view.far_m;
    const AirView air = air_before(frame.scene, frame.air, frame.lighting, view, way, depth_m * length);
    const Rgb seen = met ? surface_radiance(frame.lighting, hit, eye + direction * hit.along, way * -1.0)
                         : sky_radiance(frame.scene.sky, direction);
    return {seen * air.clear + air.glow, met ? hit.along : std::numeric_limits<double>::infinity()};
}

void blend(scene::Blending blending, const Dab& dab, double z, Canvas& canvas)
{
    if (blending != scene::Blending::additive) canvas.colour = canvas.colour * (1 - dab.alpha);
    canvas.colour = canvas.colour + dab.colour * dab.alpha;
    if (blending == scene::Blending::opaque) canvas.z = z;
}

void draw_sprite(const Frame& frame, const Sprite& sprite, int y, std::vector<Canvas>& row)
{
    const double pixel_y = y + 0.5;
    const double reach = sprite.r * (1 + sprite.streak.half);
    if (std::abs(pixel_y - sprite.y) > reach) return;
    const int last = std::min(frame.view.width_px - 1, static_cast<int>(std::floor(sprite.x + reach)));
    for (int x = std::max(0, static_cast<int>(std::floor(sprite.x - reach))); x <= last; ++x)
    {
        Canvas& canvas = row[static_cast<std::size_t>(x)];
        const Dab dab = dab_at(sprite, frame.scene, frame.world, frame.crystals, x + 0.5, pixel_y, canvas.z);
        if (dab.alpha > 0) blend(frame.scene.render.blending, dab, sprite.z, canvas);
    }
}

void draw_row(const Frame& frame, int y, image::Image& out)
{
    std::vector<Canvas> row(static_cast<std::size_t>(frame.view.width_px));
    for (int x = 0; x < frame.view.width_px; ++x)
        row[static_cast<std::size_t>(x)] = empty_canvas(frame, x, y);
    for (const Sprite& sprite : frame.sprites) draw_sprite(frame, sprite, y, row);
    for (int x = 0; x < frame.view.width_px; ++x)
    {
        const Rgb& colour = row[static_cast<std::size_t>(x)].colour;
        const double rgba[] = {colour.x, colour.y, colour.z, 1};
        std::transform(rgba, rgba + 4, out.pixel(x, y),
                       [](double value) { return static_cast<float>(value); });
    }
}

}  // namespace

image::Image render(const scene::Scene& scene, const scene::Geometry& geometry, const World& world,
                    const FlakeView& flakes, std::size_t used, const View& view, double time_s)
{
    const RayScene solids(scene, geometry, time_s);
    const scene::Air air = scene::air_at(scene, view, time_s);
    Lighting lighting = lighting_at(scene, geometry, air, time_s);
    const Shadows shadows(scene, world, flakes, used, solids, lighting.lights,
                          lighting.air.uniform_per_m > 0 || lighting.air.drift_per_m > 0);
    lighting.shadows = &shadows;
    static const std::vector<scene::CrystalMask> crystals = scene::grow_crystals();
    const std::vector<Sprite> sprites = make_sprites(scene, world, flakes, used, view, air, lighting, time_s);
    const Frame frame{scene, world, view, solids, air, lighting, crystals, sprites};

    image::Image out(view.width_px, view.height_px);
    const int workers = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 16U));
    std::vector<std::jthread> threads;
    for (int worker = 0; worker < workers; ++worker)
        threads.emplace_back(
            [&frame, &out, worker, workers]
            {
                for (int y = worker; y < frame.view.height_px; y += workers) draw_row(frame, y, out);
            });
    threads.clear();  // joins
    return out;
}

}  // namespace spindrift::reference
