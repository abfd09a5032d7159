// SPDX-License-Identifier: MIT
#include "bench/flake_field.h"

#include <fmt/format.h>

namespace spindrift::bench
{

namespace
{

std::string list(const Vec3d& v)
{
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

}  // namespace

scene::Scene FlakeField::scene() const
{
    return scene::parse_scene(
        fmt::format(R"([scene]
name = "field"
about = "Flakes that hang in the air."
step_s = 0.02
[domain]
min_m = [0, 0, 0]
max_m = {}
on_leave = "respawn"
[particles]
capacity = {}
[snow]
rate_mm_h = {}
weight = {}
[wind]
source = "calm"
[[emitter]]
shape = "sky"
centre_m = {}
size_m = {}
burst = {}
[ground]
kind = "none"
[camera]
fov_y_deg = 50
near_m = 0.3
far_m = {}
[[camera.key]]
time_s = 0
eye_m = {}
look_at_m = {}
{}
[render]
{})",
                    list(domain_m), flakes, rate_mm_h, weight, list(centre_m), list(size_m), flakes, far_m,
                    list(eye_m), list(look_at_m), sections, render),
        "field.toml");
}

}  // namespace spindrift::bench
