// SPDX-License-Identifier: MIT
#include "gl/active_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/light.h"
#include "scene/lamp_kind.h"
#include "scene/make_world.h"

namespace spindrift::gl
{

namespace
{

bool shines(const scene::Light& light)
{
    return light.exists && light.on &&
           (light.intensity.r > 0 || light.intensity.g > 0 || light.intensity.b > 0);
}

bool lit_at(const scene::Light& light, double time_s)
{
    return !light.flashing || flash_is_on(time_s, light.flash_rate_hz, light.flash_duty, light.flash_phase);
}

Vec3f to_float(const Vec3d& v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Vec3f local_position(const scene::Scene& scene, const scene::Light& light, double time_s)
{
    if (!light.vehicle.empty())
        for (const scene::VehicleSettings& vehicle : scene.vehicles)
            if (vehicle.name == light.vehicle)
                return scene::vehicle_at(vehicle, scene.domain, time_s) + to_float(light.position_m);
    return to_float(light.position_m - scene.domain.min_m);
}

/// Whether a ball touches the pyramid that the camera sees, guard band included. Errs towards yes.
bool in_sight(const View& view, const Vec3f& centre, float radius_m)
{
    const Vec3f rel = centre - view.eye;
    const float z = dot(rel, view.forward);
    if (z < -radius_m || z > view.far_m + radius_m) return false;
    const float height = static_cast<float>(view.height_px);
    const float width = static_cast<float>(view.width_px);
    const float tan_y = view.tan_half_fov_y * (1 + 2 * view.guard_px / height);
    const float tan_x = view.tan_half_fov_y * (width + 2 * view.guard_px) / height;
    const auto beyond_side = [&](float across, float tangent)
    { return (std::abs(across) - z * tangent) / std::sqrt(1 + tangent * tangent) > radius_m; };
    return !beyond_side(dot(rel, view.right), tan_x) && !beyond_side(dot(rel, view.up), tan_y);
}

float cosine_deg(double degrees)
{
    return static_cast<float>(std::cos(degrees * std::numbers::pi / 180.0));
}

Phase<float> phase_of(const scene::Light& light)
{
    return {light.phase, static_cast<float>(light.g), static_cast<float>(light.g_back),
            static_cast<float>(light.back_share)};
}

/// Where a lamp ends, m: at its range, or where its strongest channel has faded to the scene's dimmest light.
float range_of(const scene::Light& light, const scene::RenderSettings& render)
{
    if (std::isfinite(light.range_m) || render.dimmest_lamp_w_m2 <= 0)
        return static_cast<float>(light.range_m);
    const scene::Colour& i = light.intensity;
    return static_cast<float>(std::sqrt(double{std::max({i.r, i.g, i.b})} / render.dimmest_lamp_w_m2));
}

Lamp<float> lamp_of(const scene::Light& light, const Vec3f& position_m, float range_m)
{
    return {scene::lamp_kind(light.kind),
            position_m,
            to_float(light.direction),
            {light.intensity.r, light.intensity.g, light.intensity.b},
            range_m,
            cosine_deg(light.inner_cone_deg),
            cosine_deg(light.outer_cone_deg),
            phase_of(light),
            light.shadow};
}

}  // namespace

PackedLight pack(const Lamp<float>& lamp)
{
    PackedLight packed;
    const Vec3f& way = lamp.direction;
    packed.direction = {way.x, way.y, way.z, 0};
    packed.intensity = {lamp.intensity.x, lamp.intensity.y, lamp.intensity.z, lamp.phase.g};
    packed.limits = {1, 0, 0, 0};
    if (lamp.phase.kind == PhaseKind::double_lobe)
    {
        packed.limits[2] = lamp.phase.back_share;
        packed.limits[3] = lamp.phase.g_back;
    }
    if (lamp.phase.kind == PhaseKind::schlick)
    {
        packed.limits[2] = -1;
        packed.intensity[3] = schlick_k(lamp.phase.g);
    }
    if (lamp.kind == LampKind::directional)
    {
        packed.place = {-way.x, -way.y, -way.z, 0};
        return packed;
    }
    packed.place = {lamp.position_m.x, lamp.position_m.y, lamp.position_m.z, 1};
    packed.limits[1] = 1.0F / lamp.range_m;
    if (lamp.kind == LampKind::spot)
    {
        const float scale =
            1.0F / std::max(static_cast<float>(kNarrowestCone), lamp.cos_inner - lamp.cos_outer);
        packed.direction[3] = scale;
        packed.limits[0] = -lamp.cos_outer * scale;
    }
    return packed;
}

ActiveLights active_lights(const scene::Scene& scene, std::span<const scene::Light> model_lights,
                           const View& view, double time_s)
{
    ActiveLights active;
    const auto consider = [&](const scene::Light& light)
    {
        if (!shines(light))
        {
            ++active.absent;
            return;
        }
        if (!lit_at(light, time_s))
        {
            ++active.dark_now;
            return;
        }
        const Vec3f position = local_position(scene, light, time_s);
        const float range_m = range_of(light, scene.render);
        const bool bounded = light.kind != scene::LightKind::directional && std::isfinite(range_m);
        if (bounded && !in_sight(view, position, range_m))
            ++active.out_of_range;
        else
            active.lamps.push_back(lamp_of(light, position, range_m));
    };
    for (const scene::Light& light : scene.lights) consider(light);
    for (const scene::Light& light : model_lights) consider(light);
    std::stable_partition(active.lamps.begin(), active.lamps.end(),
                          [](const Lamp<float>& lamp) { return lamp.casts_shadow; });
    if (scene.render.scattering == scene::Scattering::legacy)
        for (Lamp<float>& lamp : active.lamps) lamp.phase = turned_round(lamp.phase);
    return active;
}

}  // namespace spindrift::gl
