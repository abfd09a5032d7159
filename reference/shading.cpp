// SPDX-License-Identifier: MIT
#include "reference/shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/airlight.h"
#include "core/surface.h"
#include "core/visibility.h"
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
    lamp.casts_shadow = light.shadow;
    lamp.phase = {light.phase, light.g, light.g_back, light.back_share};
    if (scene.render.scattering == scene::Scattering::legacy) lamp.phase = turned_round(lamp.phase);
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

Lighting lighting_at(const scene::Scene& scene, const scene::Geometry& geometry, const scene::Air& air,
                     double time_s)
{
    Lighting lighting;
    for (const auto* list : {&scene.lights, &geometry.model_lights})
        for (const scene::Light& light : *list)
            if (shines(light, time_s)) lighting.lights.push_back(lamp_of(light, scene, time_s));
    lighting.ambient = lighting.flake_ambient = rgb(scene.sky.ambient);
    if (scene.render.scattering == scene::Scattering::legacy)
        lighting.flake_ambient =
            lighting.ambient * static_cast<double>(std::max<std::size_t>(lighting.lights.size(), 1));
    if (air.law == scene::FogLaw::exponential) lighting.air = air.layers;
    return lighting;
}

FlakeLight flake_light(const Lighting& lighting, const View& view, const Vec3d& flake)
{
    const Vec3d way = wide(view.eye) - flake;
    const Vec3d to_eye = way * (1 / std::sqrt(dot(way, way)));
    FlakeLight out;
    out.ambient = lighting.flake_ambient;
    Vec3d mean{0, 0, 0};
    for (std::size_t i = 0; i < lighting.lights.size(); ++i)
    {
        const Lamp<double>& lamp = lighting.lights[i];
        LampLight<double> from = lamp_light(lamp, flake);
        from.irradiance =
            from.irradiance * (reaching(lighting.air, lamp, flake) * lighting.reaches(i, flake));
        out.lamps = out.lamps + scattered(from, lamp.phase, to_eye);
        mean = mean + from.towards * luminance(from.irradiance);
    }
    const double length = std::sqrt(dot(mean, mean));
    if (length > 0) mean = mean * (1 / length);
    out.towards = {dot(mean, wide(view.right)), dot(mean, wide(view.up)), -dot(mean, wide(view.forward))};
    return out;
}

Rgb surface_radiance(const Lighting& lighting, const Hit& hit, const Vec3d& place, const Vec3d& to_eye)
{
    const scene::Material& material = hit.material;
    const Vec3d albedo = rgb(material.albedo);
    const bool shiny = material.roughness < 1;
    const Gloss<double> gloss = shiny
                                    ? gloss_of(albedo, double{material.roughness}, double{material.metallic})
                                    : Gloss<double>{{}, albedo, 0};
    Rgb sum = product(albedo, lighting.ambient) * (0.75 + 0.25 * hit.normal.z) + rgb(material.emission);
    constexpr double kOff_m = 1e-6;  // a surface does not hide itself
    for (std::size_t i = 0; i < lighting.lights.size(); ++i)
    {
        const Lamp<double>& lamp = lighting.lights[i];
        const LampLight<double> from = lamp_light(lamp, place);
        const double share =
            reaching(lighting.air, lamp, place) * lighting.reaches(i, place + hit.normal * kOff_m);
        const double facing = std::max(dot(hit.normal, from.towards), 0.0) * share / std::numbers::pi;
        sum = sum + product(gloss.matt, from.irradiance) * facing;
        if (!shiny) continue;
        const double lobe = highlight(gloss.exponent, hit.normal, from.towards, to_eye);
        sum = sum + product(gloss.mirrored, from.irradiance) * (lobe * share);
    }
    return sum;
}

AirView air_before(const scene::Scene& scene, const scene::Air& air, const Lighting& lighting,
                   const View& view, const Vec3d& way, double distance_m)
{
    if (!air.thick()) return {};
    const AirPath<double> path(air.layers, air.volume(), wide(view.eye), way, dot(way, wide(view.forward)));
    AirView seen;
    if (air.law == scene::FogLaw::legacy)
    {
        // Beyond the flakes' volume, which the eye may be in.
        const double before_m = path.enters_m > 0 ? 0 : std::min(path.leaves_m, distance_m);
        seen.clear = report_transmittance(air.visibility_share, distance_m - before_m);
    }
    else
        seen.clear = std::exp(-path.of_fog(distance_m));
    Rgb source = lighting.flake_ambient;
    for (std::size_t i = 0; i < lighting.lights.size(); ++i)
    {
        const Lamp<double>& lamp = lighting.lights[i];
        const auto reach = [&](const Vec3d& place) { return lighting.reaches(i, place); };
        if (lamp.kind == LampKind::directional)
        {
            const double share = lamp.casts_shadow ? share_in_fog(path, distance_m, reach) : 1;
            source =
                source + lamp.intensity * (share * scattered_share(lamp.phase, -dot(lamp.direction, way)));
        }
        else if (scene.air.airlight && air.law == scene::FogLaw::exponential)
            seen.glow = seen.glow + airlight_to(path, lamp, distance_m, reach);
    }
    seen.glow = seen.glow + source * (1 - seen.clear);
    return seen;
}

}  // namespace spindrift::reference
