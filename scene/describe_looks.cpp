// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/shadow.h"
#include "scene/describe_scene.h"
#include "scene/sort_names.h"

namespace spindrift::scene
{
namespace
{

constexpr std::array<Named<LightKind>, 3> kLights{
    {{LightKind::point, "point"}, {LightKind::spot, "spot"}, {LightKind::directional, "directional"}}};
constexpr std::array<Named<Blending>, 5> kBlendings{{{Blending::over, "over"},
                                                     {Blending::additive, "additive"},
                                                     {Blending::weighted, "weighted"},
                                                     {Blending::stochastic, "stochastic"},
                                                     {Blending::opaque, "opaque"}}};
constexpr std::array<Named<Sprite>, 2> kSprites{{{Sprite::crystal, "crystal"}, {Sprite::point, "point"}}};

constexpr std::array<Named<PhaseKind>, 3> kPhases{{{PhaseKind::henyey_greenstein, "henyey-greenstein"},
                                                   {PhaseKind::double_lobe, "double"},
                                                   {PhaseKind::schlick, "schlick"}}};
constexpr std::array<Named<Scattering>, 2> kScatterings{
    {{Scattering::physical, "physical"}, {Scattering::legacy, "legacy"}}};
/// With the second lobe's defaults the mean cosine stays 0.77: 0.9 · 0.889 - 0.1 · 0.3.
constexpr double kFrontLobe = 0.889;
constexpr std::array<Named<FlakePath>, 3> kFlakePaths{
    {{FlakePath::automatic, "auto"}, {FlakePath::raster, "raster"}, {FlakePath::tiles, "tiles"}}};

constexpr Range kShare{.min = 0, .max = 1};
constexpr Range kLightAmount{.min = 0, .max = 1e9};

void describe_flashing(Section& section, Light& light)
{
    section.flag({.name = "flashing", .about = "whether it goes on and off"}, light.flashing);
    constexpr std::string_view kWhen = "with flashing = true";
    section.number({.name = "flash_rate_hz",
                    .about = "flashes per second",
                    .applies = light.flashing,
                    .applies_when = kWhen},
                   {.min = 0.001, .max = 1000}, light.flash_rate_hz);
    section.number({.name = "flash_duty",
                    .about = "share of the period that it is on",
                    .applies = light.flashing,
                    .applies_when = kWhen},
                   kShare, light.flash_duty);
    section.number({.name = "flash_phase",
                    .about = "share of the period by which it is ahead",
                    .applies = light.flashing,
                    .applies_when = kWhen},
                   kShare, light.flash_phase);
}

void describe_light_place(Section& section, Light& light)
{
    const bool placed = light.kind != LightKind::directional;
    const bool aimed = light.kind != LightKind::point;
    const bool spot = light.kind == LightKind::spot;
    constexpr std::string_view kPlaced = "with kind = \"point\" or \"spot\"";
    constexpr std::string_view kSpot = "with kind = \"spot\"";
    section.triple({.name = "position_m",
                    .about = "of the lamp, world frame or its vehicle's",
                    .required = true,
                    .applies = placed,
                    .applies_when = kPlaced},
                   kCoordinate, light.position_m);
    section.triple({.name = "direction",
                    .about = "the way the light travels, any length",
                    .required = true,
                    .applies = aimed,
                    .applies_when = "with kind = \"spot\" or \"directional\""},
                   {.min = -1e6, .max = 1e6}, light.direction);
    const double length = std::sqrt(dot(light.direction, light.direction));
    section.require(length > 1e-6, "direction", "has no length (it points nowhere)",
                    "use a vector longer than 1e-6");
    if (length > 0) light.direction = light.direction * (1 / length);
    section.number(
        {.name = "range_m",
         .about = "distance at which it has faded to nothing; without it, by distance squared only",
         .applies = placed,
         .applies_when = kPlaced},
        {.min = 0.1, .max = 1e5}, light.range_m);
    section.number({.name = "inner_cone_deg",
                    .about = "half angle of full light",
                    .applies = spot,
                    .applies_when = kSpot},
                   {.min = 0, .max = 90}, light.inner_cone_deg);
    section.number({.name = "outer_cone_deg",
                    .about = "half angle at which the light ends",
                    .applies = spot,
                    .applies_when = kSpot},
                   {.min = 0, .max = 90, .above_min = true}, light.outer_cone_deg);
    section.require(
        light.inner_cone_deg <= light.outer_cone_deg, "inner_cone_deg",
        fmt::format("is above outer_cone_deg = {} (the cone would be inside out)", light.outer_cone_deg),
        "use at most outer_cone_deg");
}

void describe_phase(Section& section, Light& light)
{
    section.choice(
        {.name = "phase",
         .about = "how flakes scatter this light: one Henyey-Greenstein lobe, two of them, or Schlick's "
                  "cheaper stand-in for one"},
        kPhases, light.phase);
    const bool two = light.phase == PhaseKind::double_lobe;
    if (two) light.g = kFrontLobe;
    section.number(
        {.name = "g",
         .about = "how far flakes throw this light forward; 0: evenly. Of the front lobe with phase = "
                  "\"double\", then 0.889 by default"},
        {.min = -0.99, .max = 0.99, .why = "at 1 and -1 nothing is scattered aside"}, light.g);
    section.require(
        light.phase != PhaseKind::schlick || std::abs(light.g) <= kLargestSchlickG, "g",
        "is too near to 1 for Schlick's function (from 0.938 on it has a pole)",
        fmt::format("use {} to {}, or phase = \"henyey-greenstein\"", -kLargestSchlickG, kLargestSchlickG));
    section.number({.name = "g_back",
                    .about = "of the second lobe; negative: back to the lamp",
                    .applies = two,
                    .applies_when = "with phase = \"double\""},
                   {.min = -0.99, .max = 0.99}, light.g_back);
    section.number({.name = "back_share",
                    .about = "share of the light that the second lobe takes",
                    .applies = two,
                    .applies_when = "with phase = \"double\""},
                   kShare, light.back_share);
}

void describe_shadow(Section& section, Light& light, const std::vector<Light>& before)
{
    section.flag({.name = "shadow",
                  .about = "what stands in its way casts a shadow, on surfaces, flakes and fog",
                  .applies = light.kind != LightKind::point,
                  .applies_when = "with kind = \"spot\" or \"directional\""},
                 light.shadow);
    if (!light.shadow) return;
    section.require(
        light.kind != LightKind::spot || light.outer_cone_deg <= kWidestShadow_deg, "shadow",
        fmt::format("is not to be had with outer_cone_deg = {} (one flat map holds no wider cone)",
                    light.outer_cone_deg),
        fmt::format("use an outer_cone_deg of at most {}", kWidestShadow_deg));
    const auto casters = static_cast<std::size_t>(
        std::count_if(before.begin(), before.end(), [](const Light& other) { return other.shadow; }));
    section.require(casters < kMostShadows, "shadow",
                    fmt::format("is true for a light more than {} (so many maps are kept)", kMostShadows),
                    fmt::format("let at most {} lights cast shadows", kMostShadows));
}

void describe_light(Section& section, std::vector<Light>& lights,
                    const std::vector<VehicleSettings>& vehicles)
{
    Light light;
    section.choice({.name = "kind",
                    .about = "a point that shines everywhere, a cone, or parallel light",
                    .required = true},
                   kLights, light.kind);
    section.text({.name = "name", .about = "for people and messages"}, light.name);
    const auto same = [&](const Light& other) { return !light.name.empty() && other.name == light.name; };
    section.require(std::none_of(lights.begin(), lights.end(), same), "name",
                    "names a second light (it could not be told apart)", "use each name once");
    section.flag({.name = "exists", .about = "false: the lamp is not there at all"}, light.exists);
    section.flag({.name = "on", .about = "false: the lamp is there but dark"}, light.on);
    describe_vehicle_reference(section, "moves with that vehicle; its place and direction count from there",
                               light.vehicle, vehicles);
    describe_light_place(section, light);
    const bool directional = light.kind == LightKind::directional;
    section.triple({.name = "intensity_w_sr",
                    .about = "radiant intensity: red, green, blue, linear, without upper end",
                    .required = true,
                    .applies = !directional,
                    .applies_when = "with kind = \"point\" or \"spot\""},
                   kLightAmount, light.intensity);
    section.triple({.name = "irradiance_w_m2",
                    .about = "on a face towards the light: red, green, blue, linear",
                    .required = true,
                    .applies = directional,
                    .applies_when = "with kind = \"directional\""},
                   kLightAmount, light.intensity);
    describe_phase(section, light);
    describe_flashing(section, light);
    describe_shadow(section, light, lights);
    lights.push_back(light);
}

void describe_shadows(Section& section, ShadowSettings& shadows, const std::vector<Light>& lights)
{
    const bool casts =
        std::any_of(lights.begin(), lights.end(), [](const Light& light) { return light.shadow; });
    constexpr std::string_view kWhen = "with a [[light]] that has shadow = true";
    section.whole({.name = "map_px",
                   .about = "edge of a light's map of what the scene hides from it; more are sharper",
                   .applies = casts,
                   .applies_when = kWhen},
                  {.min = 16, .max = 4096, .why = "a larger one takes 64 MiB and more"}, shadows.map_px);
    section.whole({.name = "snow_slices",
                   .about = "slices across the light's way in which drawn flakes dim it; 0: they do not",
                   .applies = casts,
                   .applies_when = kWhen},
                  {.min = 0, .max = 64}, shadows.snow_slices);
    section.whole({.name = "snow_px",
                   .about = "edge of a slice",
                   .applies = casts && shadows.snow_slices > 0,
                   .applies_when = "with snow_slices above 0"},
                  {.min = 8, .max = 256, .why = "more, and each holds too few flakes to be even"},
                  shadows.snow_px);
}

void describe_sky_looks(Section& section, SkySettings& sky)
{
    section.triple({.name = "zenith_w_sr_m2", .about = "radiance overhead: red, green, blue, linear"},
                   kLightAmount, sky.zenith);
    section.triple({.name = "horizon_w_sr_m2", .about = "radiance at the horizon and below"}, kLightAmount,
                   sky.horizon);
    section.triple(
        {.name = "ambient_w_sr_m2", .about = "light that reaches everything once, as irradiance over pi"},
        kLightAmount, sky.ambient);
}

/// Smallest angle's sine between the view and the vertical on the straight way from one key to the next; 0
/// when the eye meets its target.
double least_horizontal_share(const Vec3d& from, const Vec3d& to)
{
    const Vec3d change = to - from;
    const double change2 = change.x * change.x + change.y * change.y;
    const double nearest = change2 > 0 ? -(from.x * change.x + from.y * change.y) / change2 : 0;
    double least = 1;
    for (const double t : {0.0, std::clamp(nearest, 0.0, 1.0), 1.0})
    {
        const Vec3d look = from + change * t;
        const double length = std::sqrt(dot(look, look));
        least = std::min(least, length > 1e-3 ? std::hypot(look.x, look.y) / length : 0.0);
    }
    return least;
}

void describe_camera_key(Section& section, CameraKey& key, const std::vector<CameraKey>& before)
{
    section.triple({.name = "eye_m", .about = "where the camera is, world frame", .required = true},
                   kCoordinate, key.eye_m);
    section.triple({.name = "look_at_m", .about = "what it looks at", .required = true}, kCoordinate,
                   key.look_at_m);
    const Vec3d look = key.look_at_m - key.eye_m;
    section.require(dot(look, look) > 1e-6, "look_at_m", "equals eye_m (the camera looks nowhere)",
                    "use a point at least 0.001 m away from eye_m");
    constexpr double kLeastShare = 1e-3;  // 0.06 degrees: what single precision still tells from straight up
    section.require(least_horizontal_share(look, look) > kLeastShare, "look_at_m",
                    "is straight above or below eye_m (no side of the picture would be up)",
                    "move it sideways by a thousandth of the distance or more");
    if (before.empty()) return;
    const Vec3d last = before.back().look_at_m - before.back().eye_m;
    section.require(least_horizontal_share(last, look) > kLeastShare, "look_at_m",
                    "makes the camera look straight up or down, or at itself, on the way from the key before",
                    "add a key between them");
}

void describe_camera(Section& section, CameraSettings& camera)
{
    section.number({.name = "fov_y_deg", .about = "vertical angle of view"},
                   {.min = 1, .max = 170, .why = "a flat picture holds no wider angle"}, camera.fov_y_deg);
    section.number({.name = "near_m", .about = "nothing nearer is drawn"}, {.min = 1e-3, .max = 1e4},
                   camera.near_m);
    section.number({.name = "far_m", .about = "nothing farther is drawn"}, {.min = 1e-2, .max = 1e6},
                   camera.far_m);
    section.require(camera.near_m < camera.far_m, "far_m",
                    fmt::format("is not above near_m = {} (nothing would be seen)", camera.near_m),
                    "use more than near_m");
    describe_path(section, "the camera's way, piecewise linear in time, held at both ends", camera.keys,
                  [&](Section& key_section, CameraKey& key)
                  { describe_camera_key(key_section, key, camera.keys); });
    section.require(!camera.keys.empty(), "key", "is empty (the camera is nowhere)",
                    "give at least one [[camera.key]]");
}

void describe_picture(Section& section, RenderSettings& render)
{
    constexpr Range kPixels{.min = 1, .max = 16384, .why = "OpenGL draws no larger picture"};
    section.whole({.name = "width_px", .about = "of the picture; also --size"}, kPixels, render.width_px);
    section.whole({.name = "height_px", .about = "of the picture; also --size"}, kPixels, render.height_px);
    section.number({.name = "frames_per_s", .about = "of the film; also --fps"}, {.min = 0.01, .max = 1000},
                   render.frames_per_s);
    section.whole({.name = "frames", .about = "to draw without a window; also --frames"},
                  {.min = 1, .max = 1e7, .allowed = "1 to 10000000"}, render.frames);
    section.number({.name = "warm_up_s", .about = "time that passes before the first frame"},
                   {.min = 0, .max = 36000}, render.warm_up_s);
}

void describe_render(Section& section, RenderSettings& render)
{
    describe_picture(section, render);
    section.choice({.name = "blending",
                    .about = "sorted far to near, or without a sort: added, weighted by depth, by chance in "
                             "each sample of a pixel, or opaque; also --blending"},
                   kBlendings, render.blending);
    const bool by_chance = render.blending == Blending::stochastic;
    section.whole({.name = "samples",
                   .about = "of a pixel; the more, the less noise",
                   .applies = by_chance,
                   .applies_when = "with blending = \"stochastic\""},
                  {.min = 2, .max = 16, .allowed = "2, 4, 8 or 16"}, render.samples);
    section.require((render.samples & (render.samples - 1)) == 0, "samples",
                    "is not a power of two (graphics cards have no other samples)", "use 2, 4, 8 or 16");
    section.choice({.name = "sprite", .about = "grown crystals, or plain points"}, kSprites, render.sprite);
    section.choice(
        {.name = "scattering",
         .about = "physical, or as the report prints it: back for forward, ambient light once per lamp"},
        kScatterings, render.scattering);
    section.choice(
        {.name = "flake_path",
         .about = "as points by GL's rasteriser, or in tiles by the processor; auto: tiles on software GL; "
                  "also --flake-path"},
        kFlakePaths, render.flake_path);
    std::size_t sort = static_cast<std::size_t>(std::find(kSortNames.begin(), kSortNames.end(), render.sort) -
                                                kSortNames.begin());
    section.choice({.name = "sort", .about = "strategy of the depth sort (docs/sorting.md); also --sort"},
                   std::span<const std::string_view>(kSortNames), sort);
    render.sort = kSortNames.at(sort);
    section.whole(
        {.name = "depth_bits", .about = "of the sort key; fewer are faster and blend near ties in any order"},
        {.min = 16, .max = 32, .allowed = "16, 24 or 32"}, render.depth_bits);
    section.require(render.depth_bits % 8 == 0, "depth_bits",
                    "is not a width that the sorts have (whole bytes)", "use 16, 24 or 32");
    section.whole({.name = "sort_passes_per_frame",
                   .about = "steps of bitonic-passes and odd-even-passes; also --sort-passes"},
                  {.min = 1, .max = 4096}, render.sort_passes_per_frame);
    describe_exposure(section, render);
    section.number({.name = "dimmest_lamp_w_m2",
                    .about = "irradiance at which a lamp without a range ends, so that many of them cost "
                             "little; 0: it reaches everything"},
                   {.min = 0, .max = 1e6}, render.dimmest_lamp_w_m2);
    section.number({.name = "shutter_s",
                    .about = "how long flakes are seen while they fly: they are drawn as streaks; 0: at an "
                             "instant. Also --shutter",
                    .applies = render.blending != Blending::opaque,
                    .applies_when = "with any blending but \"opaque\""},
                   {.min = 0, .max = 1}, render.shutter_s);
    section.number({.name = "flake_opacity", .about = "at the centre of a flake"}, kShare,
                   render.flake_opacity);
    section.number({.name = "flake_scale",
                    .about = "drawn over real diameter; snow.weight over its square keeps the optical depth"},
                   {.min = 0.01, .max = 1000}, render.flake_scale);
}

}  // namespace

void describe_looks(Section& root, Scene& scene)
{
    root.sections({.name = "light", .about = "lamps and the sun"},
                  [&](Section& s) { describe_light(s, scene.lights, scene.vehicles); });
    root.section({.name = "shadows", .about = "maps of what the lights that cast shadows cannot reach"},
                 [&](Section& s) { describe_shadows(s, scene.shadows, scene.lights); });
    root.section({.name = "sky", .about = "background and the light that comes from everywhere"},
                 [&](Section& s) { describe_sky_looks(s, scene.sky); });
    root.section({.name = "camera", .about = "who looks", .required = true},
                 [&](Section& s) { describe_camera(s, scene.camera); });
    root.section({.name = "render", .about = "the pictures"},
                 [&](Section& s) { describe_render(s, scene.render); });
    describe_development(root, scene);
}

}  // namespace spindrift::scene
