// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "scene/make_world.h"

namespace spindrift::scene
{

namespace
{

Vec3f narrow(const Vec3d& v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Vec3d mix(const Vec3d& a, const Vec3d& b, double share)
{
    return a + (b - a) * share;
}

/// Piecewise linear over keys with ascending times, held at both ends: `blend(low, high, share)`.
template <class Keys, class Blend>
auto at_time(const Keys& keys, double time_s, Blend blend)
{
    const auto above = std::upper_bound(keys.begin(), keys.end(), time_s,
                                        [](double t, const auto& key) { return t < key.time_s; });
    if (above == keys.begin()) return blend(keys.front(), keys.front(), 0.0);
    if (above == keys.end()) return blend(keys.back(), keys.back(), 0.0);
    const auto& low = *(above - 1);
    return blend(low, *above, (time_s - low.time_s) / (above->time_s - low.time_s));
}

bool normalise(Vec3d& v)
{
    const double length = std::sqrt(dot(v, v));
    if (!(length > 1e-9)) return false;
    v = v * (1 / length);
    return true;
}

}  // namespace

View camera_at(const Scene& scene, double time_s)
{
    const CameraKey key =
        at_time(scene.camera.keys, time_s,
                [](const CameraKey& a, const CameraKey& b, double share) {
                    return CameraKey{0, mix(a.eye_m, b.eye_m, share), mix(a.look_at_m, b.look_at_m, share)};
                });
    Vec3d forward = key.look_at_m - key.eye_m;
    if (!normalise(forward)) forward = {0, 1, 0};  // keys that pass through each other: look north
    // straight up or down has no horizon: the picture's right is then east, its top north or south
    Vec3d right = cross(forward, Vec3d{0, 0, 1});
    if (dot(right, right) < 1e-12 || !normalise(right)) right = {1, 0, 0};
    Vec3d up = cross(right, forward);
    normalise(up);

    View view;
    view.eye = narrow(key.eye_m - scene.domain.min_m);
    view.forward = narrow(forward);
    view.right = narrow(right);
    view.up = narrow(up);
    view.tan_half_fov_y =
        static_cast<float>(std::tan(scene.camera.fov_y_deg * (3.14159265358979323846 / 360.0)));
    view.width_px = scene.render.width_px;
    view.height_px = scene.render.height_px;
    view.near_m = static_cast<float>(scene.camera.near_m);
    view.far_m = static_cast<float>(scene.camera.far_m);
    return view;
}

Vec3f vehicle_at(const VehicleSettings& vehicle, const DomainSettings& domain, double time_s)
{
    if (vehicle.path.keys.empty()) return narrow(Vec3d{} - domain.min_m);
    return at_time(vehicle.path.keys, time_s,
                   [&](const VehicleSettings::Key& a, const VehicleSettings::Key& b, double share)
                   { return narrow(mix(a.position_m, b.position_m, share) - domain.min_m); });
}

}  // namespace spindrift::scene
