// SPDX-License-Identifier: MIT
#include "reference/shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/lamp_kind.h"
#include "scene/make_world.h"

namespace spindrift::reference
{

namespace
{

bool shines(const scene::Light& light, double time_s)
{
    if (!light.exists || !light.on) return false;
    return !light.flashing || flash_is_on(time_s, light.flash_rate_hz, light.flash_duty, light.flash_phase);
}

Vec3d local_position(const scene::Light& light, const scene::Scene& scene, double time_s)
{
    for (const scene::VehicleSettings& vehicle : scene.vehicles)
        if (!light.vehicle.empty() && vehicle.name == light.vehicle)
            return wide(scene::vehicle_at(vehicle, scene.domain, time_s)) + light.position_m;
    return light.position_m - scene.domain.min_m;
}

Lamp<double> lamp_of(const scene::Light& light, const scene::Scene& scene, double time_s)
{
    const auto cosine = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180); };
    Lamp<double> lamp;
    lamp.kind = scene::lamp_kind(light.kind);
    lamp.position_m = local_position(light, scene, time_s);
    lamp.direction = light.direction;
    lamp.intensity = rgb(light.intensity);
    lamp.range_m = light.range_m;
    lamp.cos_inner = cosine(light.inner_cone_deg);
    lamp.cos_outer = cosine(light.outer_cone_deg);
    lamp.g = light.g;
    return lamp;
}

Rgb product(const Rgb& a, const Rgb& b)
{
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

}  // namespace

Rgb rgb(const scene::Colour& colour)
{
    return {colour.r, colour.g, colour.b};
}

Vec3d wide(const Vec3f& v)
{
    return {v.x, v.y, v.z};
}

Lights lights_at(const scene::Scene& scene, const scene::Geometry& geometry, double time_s)
{
    Lights lights;
    for (const auto* list : {&scene.lights, &geometry.model_lights})
        for (const scene::Light& light : *list)
            if (shines(light, time_s)) lights.push_back(lamp_of(light, scene, time_s));
    return lights;
}

FlakeLight flake_light(const Lights& lights, const scene::SkySettings& sky, const View& view,
                       const Vec3d& flake)
{
    const Vec3d way = wide(view.eye) - flake;
    const Vec3d to_eye = way * (1 / std::sqrt(dot(way, way)));
    FlakeLight out;
    out.ambient = rgb(sky.ambient);
    Vec3d mean{0, 0, 0};
    for (const Lamp<double>& lamp : lights)
    {
        const LampLight<double> from = lamp_light(lamp, flake);
        out.lamps = out.lamps + scattered(from, lamp.g, to_eye);
        mean = mean + from.towards * luminance(from.irradiance);
    }
    const double length = std::sqrt(dot(mean, mean));
    if (length > 0) mean = mean * (1 / length);
    out.towards = {dot(mean, wide(view.right)), dot(mean, wide(view.up)), -dot(mean, wide(view.forward))};
    return out;
}

Rgb surface_radiance(const Lights& lights, const scene::SkySettings& sky, const Hit& hit, const Vec3d& place)
{
    Rgb sum = rgb(sky.ambient) * (0.75 + 0.25 * hit.normal.z);
    for (const Lamp<double>& lamp : lights)
    {
        const LampLight<double> from = lamp_light(lamp, place);
        sum = sum + from.irradiance * (std::max(dot(hit.normal, from.towards), 0.0) / std::numbers::pi);
    }
    return product(rgb(hit.material.albedo), sum) + rgb(hit.material.emission);
}

}  // namespace spindrift::reference
