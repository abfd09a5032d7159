// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/error.h"
#include "scene/scene.h"

// Any bytes are a scene or an Error; nothing else leaves parse_scene, and what it accepts can be run.

namespace
{

void demand(bool ok)
{
    if (!ok) std::abort();
}

bool finite(const spindrift::Vec3d& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check(const spindrift::scene::Scene& scene)
{
    const spindrift::Vec3d size = scene.domain.max_m - scene.domain.min_m;
    demand(finite(size) && size.x > 0 && size.y > 0 && size.z > 0);
    demand(scene.capacity >= 1 && scene.capacity <= UINT32_MAX);
    demand(scene.step_s >= 1e-4 && scene.step_s <= 10);
    demand(scene.snow.weight > 0 && std::isfinite(scene.snow.weight));
    demand(!scene.camera.keys.empty() && scene.camera.near_m < scene.camera.far_m);
    demand(scene.render.width_px >= 1 && scene.render.height_px >= 1 && scene.render.frames >= 1);
    demand(scene.emitters.size() <= 255);
    for (const auto& settings : scene.emitters)
    {
        const spindrift::Emitter& emitter = settings.emitter;
        demand(finite(settings.a) && finite(settings.b) && finite(settings.c) &&
               std::isfinite(emitter.radius_m));
        demand(emitter.burst <= scene.capacity && std::isfinite(emitter.rate_per_s));
    }
    for (const auto& light : scene.lights)
        demand(std::abs(std::hypot(light.direction.x, light.direction.y, light.direction.z) - 1) < 1e-6);
    for (const auto& vehicle : scene.vehicles) demand(!vehicle.path.keys.empty() && !vehicle.name.empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    spindrift::scene::SceneOverrides overrides;
    if (size % 2 == 1)  // half of the inputs meet a command line
    {
        overrides.particles = 1000;
        overrides.frames = 3;
        overrides.winds_file = "w.nc";
    }
    try
    {
        check(spindrift::scene::parse_scene(text, "fuzz.toml", overrides));
    }
    catch (const spindrift::Error& error)
    {
        const std::string_view message = error.what();
        demand(message.find('\n') == std::string_view::npos && message.size() < 4096);
    }
    return 0;
}
