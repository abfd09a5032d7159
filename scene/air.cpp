// SPDX-License-Identifier: MIT
#include "scene/air.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/visibility.h"
#include "scene/make_world.h"

namespace spindrift::scene
{

namespace
{

Vec3d wide(const Vec3f& v)
{
    return {v.x, v.y, v.z};
}

const EmitterSettings* sky_of(const Scene& scene)
{
    const auto sky =
        std::find_if(scene.emitters.begin(), scene.emitters.end(),
                     [](const EmitterSettings& e) { return e.emitter.shape == EmitterShape::sky; });
    return sky == scene.emitters.end() ? nullptr : &*sky;
}

/// The sky's box where it is then, cut at the ground and the domain; local frame.
FlakeBox sky_box(const Scene& scene, const EmitterSettings& sky, double time_s)
{
    Vec3d centre = sky.a - scene.domain.min_m;
    if (sky.follows == "camera") centre = wide(camera_at(scene, time_s).eye);
    for (const VehicleSettings& vehicle : scene.vehicles)
        if (!sky.follows.empty() && vehicle.name == sky.follows)
            centre = wide(vehicle_at(vehicle, scene.domain, time_s));
    const Vec3d half = sky.b * 0.5, size = scene.domain.max_m - scene.domain.min_m;
    FlakeBox box{centre - half, centre + half};
    const double floor =
        scene.ground.kind == GroundKind::none ? 0 : scene.ground.height_m - scene.domain.min_m.z;
    box.low = {std::max(box.low.x, 0.0), std::max(box.low.y, 0.0), std::max({box.low.z, 0.0, floor})};
    box.high = {std::min(box.high.x, size.x), std::min(box.high.y, size.y), std::min(box.high.z, size.z)};
    return box;
}

double volume_of(const FlakeBox& box)
{
    const Vec3d size = box.high - box.low;
    return std::min({size.x, size.y, size.z}) > 0 ? size.x * size.y * size.z : 0;
}

double density_of(const Scene& scene, double time_s)
{
    const EmitterSettings* sky = sky_of(scene);
    if (sky == nullptr) return 0;
    const double volume = volume_of(sky_box(scene, *sky, time_s));
    return volume > 0 ? static_cast<double>(sky->emitter.burst) / volume : 0;
}

double grey_of(const AirSettings& air)
{
    return air.fit == ReportFit::legacy ? report_grey(air.particles_per_s)
                                        : cover_grey(air.particles_per_s, kReportCover_s);
}

double visibility_share(const Scene& scene)
{
    const AirSettings& air = scene.air;
    if (air.source == AirSource::particle_rate) return 1 - grey_of(air) / 255;
    const double extinction = uniform_extinction(scene);
    return std::clamp(visibility_of_extinction(extinction, air.contrast) / kReportFarthest_m, 0.0, 1.0);
}

}  // namespace

FlakeBox flake_box(const Scene& scene, double time_s)
{
    const EmitterSettings* sky = sky_of(scene);
    if (sky != nullptr && scene.emitters.size() == 1) return sky_box(scene, *sky, time_s);
    return {{0, 0, 0}, scene.domain.max_m - scene.domain.min_m};
}

double uniform_extinction(const Scene& scene)
{
    const AirSettings& air = scene.air;
    switch (air.source)
    {
        case AirSource::clear:
            return 0;
        case AirSource::visibility:
            return extinction_of_visibility(air.visibility_m, air.contrast);
        case AirSource::snowfall:
            return extinction_of_snowfall(scene.snow);
        case AirSource::concentration:
            return extinction_of_concentration(air.snow_g_m3);
        case AirSource::particle_rate:
            return extinction_of_visibility(report_visibility_m(grey_of(air)), air.contrast);
        case AirSource::flakes:
            return flake_extinction(scene);
    }
    return 0;
}

double flake_extinction(const Scene& scene)
{
    const double flakes_per_m3 = density_of(scene, 0);
    return flakes_per_m3 > 0 ? flakes_per_m3 * full_flake_area_m2(scene.render, scene.snow) : 0;
}

AirLayers<double> layers_of(const Scene& scene)
{
    AirLayers<double> layers;
    layers.uniform_per_m = uniform_extinction(scene);
    if (std::isfinite(scene.air.drift_visibility_m))
        layers.drift_per_m = extinction_of_visibility(scene.air.drift_visibility_m, scene.air.contrast);
    layers.drift_height_m = scene.air.drift_height_m;
    layers.drift_base_m = scene.air.drift_base_m - scene.domain.min_m.z;
    return layers;
}

double far_transmittance(const Scene& scene, const View& view)
{
    const AirLayers<double> layers = layers_of(scene);
    const double eye = view.eye.z;
    double most = 0;
    for (const double up : {-1.0, 0.0, 1.0})
        for (const double right : {-1.0, 0.0, 1.0})
        {
            const double tan_x = static_cast<double>(view.tan_half_fov_y) * view.width_px / view.height_px;
            const Vec3d way = wide(view.forward) + wide(view.right) * (right * tan_x) +
                              wide(view.up) * (up * static_cast<double>(view.tan_half_fov_y));
            const double length = view.far_m * std::sqrt(dot(way, way));
            most = std::max(most, optical_depth(layers, eye, eye + view.far_m * way.z, length));
        }
    return std::exp(-most);
}

void move_volume(Air& air, const Scene& scene, double time_s)
{
    const EmitterSettings* sky = sky_of(scene);
    if (sky == nullptr) return;
    const FlakeBox box = sky_box(scene, *sky, time_s);
    air.low = box.low;
    air.high = box.high;
    air.flakes_per_m3 = density_of(scene, time_s);
}

bool same_lens(const View& a, const View& b)
{
    return a.tan_half_fov_y == b.tan_half_fov_y && a.height_px == b.height_px && a.near_m == b.near_m &&
           a.far_m == b.far_m && a.guard_px == b.guard_px;
}

Air air_at(const Scene& scene, const View& view, double time_s)
{
    Air air;
    air.layers = layers_of(scene);
    air.law = scene.air.law;
    if (air.law == FogLaw::legacy) air.visibility_share = visibility_share(scene);
    air.tiny_flakes_fade = air.thick() && air.law == FogLaw::exponential;
    move_volume(air, scene, time_s);
    if (air.tiny_flakes_fade && air.flakes_per_m3 > 0)
        air.shade =
            make_flake_shade(scene.render, scene.snow, view, air.layers.uniform_per_m / air.flakes_per_m3);
    return air;
}

}  // namespace spindrift::scene
