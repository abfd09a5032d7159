// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scene/describe_scene.h"

namespace spindrift::scene
{
namespace
{

constexpr std::array<Named<EmitterShape>, 8> kShapes{{{EmitterShape::point, "point"},
                                                      {EmitterShape::line, "line"},
                                                      {EmitterShape::sphere_surface, "sphere-surface"},
                                                      {EmitterShape::sphere_volume, "sphere-volume"},
                                                      {EmitterShape::plane, "plane"},
                                                      {EmitterShape::box, "box"},
                                                      {EmitterShape::sky, "sky"},
                                                      {EmitterShape::drift, "drift"}}};

constexpr Range kExtent{.min = 0, .max = 1e5, .above_min = true};

void describe_point_and_line(Section& section, EmitterSettings& emitter)
{
    const bool point = emitter.emitter.shape == EmitterShape::point;
    const bool line = emitter.emitter.shape == EmitterShape::line;
    section.triple({.name = "at_m",
                    .about = "the point",
                    .required = true,
                    .applies = point,
                    .applies_when = "with shape = \"point\""},
                   kCoordinate, emitter.a);
    section.triple({.name = "from_m",
                    .about = "one end of the line",
                    .required = true,
                    .applies = line,
                    .applies_when = "with shape = \"line\""},
                   kCoordinate, emitter.a);
    section.triple({.name = "to_m",
                    .about = "its other end",
                    .required = true,
                    .applies = line,
                    .applies_when = "with shape = \"line\""},
                   kCoordinate, emitter.b);
    const Vec3d along = emitter.b - emitter.a;
    section.require(!line || dot(along, along) > 0, "to_m", "equals from_m (the line has no length)",
                    "use two different ends, or shape = \"point\"");
}

void describe_sphere_and_box(Section& section, EmitterSettings& settings)
{
    Emitter& emitter = settings.emitter;
    const bool sphere =
        emitter.shape == EmitterShape::sphere_surface || emitter.shape == EmitterShape::sphere_volume;
    const bool drift = emitter.shape == EmitterShape::drift;
    const bool box = emitter.shape == EmitterShape::box || drift;
    const bool sky = emitter.shape == EmitterShape::sky;
    section.triple(
        {.name = "centre_m",
         .about = "centre of the sphere or of a sky that stands still",
         .required = true,
         .applies = sphere || (sky && settings.follows.empty()),
         .applies_when = "with shape = \"sphere-surface\" or \"sphere-volume\", or \"sky\" without follows"},
        kCoordinate, settings.a);
    section.number({.name = "radius_m",
                    .about = "of the sphere",
                    .required = true,
                    .applies = sphere,
                    .applies_when = "with shape = \"sphere-surface\" or \"sphere-volume\""},
                   kExtent, emitter.radius_m);
    section.triple({.name = "min_m",
                    .about = "lower corner of the box; of a drift: on the ground",
                    .required = true,
                    .applies = box,
                    .applies_when = "with shape = \"box\" or \"drift\""},
                   kCoordinate, settings.a);
    section.triple({.name = "max_m",
                    .about = "its upper corner; of a drift: as high as its burst hangs in the air",
                    .required = true,
                    .applies = box,
                    .applies_when = "with shape = \"box\" or \"drift\""},
                   kCoordinate, settings.b);
    const Vec3d size = settings.b - settings.a;
    section.require(!box || std::min({size.x, size.y, size.z}) > 0, "max_m",
                    "is not above min_m (the box has no inside)",
                    "use max_m above min_m on each axis, or shape = \"plane\"");
    section.number({.name = "threshold_friction_velocity_m_s",
                    .about = "u* at which the wind begins to take snow up; fresh dry 0.2, old 0.3 and more",
                    .applies = drift,
                    .applies_when = "with shape = \"drift\""},
                   {.min = 0.05, .max = 2}, settings.threshold_m_s);
    section.triple({.name = "size_m",
                    .about = "edges of the sky's box; flakes that drift out of it come in opposite",
                    .required = true,
                    .applies = sky,
                    .applies_when = "with shape = \"sky\""},
                   kExtent, settings.b);
}

void describe_plane(Section& section, EmitterSettings& emitter)
{
    const bool plane = emitter.emitter.shape == EmitterShape::plane;
    constexpr std::string_view kWhen = "with shape = \"plane\"";
    Vec3d edge_u{}, edge_v{};
    section.triple({.name = "corner_m",
                    .about = "a corner of the parallelogram",
                    .required = true,
                    .applies = plane,
                    .applies_when = kWhen},
                   kCoordinate, emitter.a);
    section.triple({.name = "edge_u_m",
                    .about = "vector from the corner along one edge",
                    .required = true,
                    .applies = plane,
                    .applies_when = kWhen},
                   kCoordinate, edge_u);
    section.triple({.name = "edge_v_m",
                    .about = "vector from the corner along the other edge",
                    .required = true,
                    .applies = plane,
                    .applies_when = kWhen},
                   kCoordinate, edge_v);
    if (!plane) return;
    emitter.b = emitter.a + edge_u;
    emitter.c = emitter.a + edge_v;
    const Vec3d normal = cross(edge_u, edge_v);
    // a billionth of the product of the edges: no more than rounding
    section.require(
        dot(normal, normal) > 1e-18 * dot(edge_u, edge_u) * dot(edge_v, edge_v) && dot(normal, normal) > 0,
        "edge_v_m", "is parallel to edge_u_m, or one of them is 0 (the plane has no area)",
        "use two edges in different directions, or shape = \"line\"");
}

/// What the emitter may reach lies in the domain: flakes outside would leave at once.
void require_inside(Section& section, const EmitterSettings& settings, const DomainSettings& domain)
{
    const Emitter& emitter = settings.emitter;
    std::vector<Vec3d> corners{settings.a};
    if (emitter.shape == EmitterShape::line || emitter.shape == EmitterShape::box ||
        emitter.shape == EmitterShape::drift)
        corners.push_back(settings.b);
    if (emitter.shape == EmitterShape::plane)
        corners.insert(corners.end(), {settings.b, settings.c, settings.b + settings.c - settings.a});
    const double radius = static_cast<double>(emitter.radius_m);
    const auto within = [&](double value, double low, double high)
    {
        const double tolerance = 1e-9 * std::max(std::abs(low), std::abs(high));  // sums of edges round
        return value - radius >= low - tolerance && value + radius <= high + tolerance;
    };
    for (const Vec3d& corner : corners)
    {
        const bool inside = within(corner.x, domain.min_m.x, domain.max_m.x) &&
                            within(corner.y, domain.min_m.y, domain.max_m.y) &&
                            within(corner.z, domain.min_m.z, domain.max_m.z);
        section.require(
            inside, "shape", "reaches out of the domain (flakes made there would leave at once)",
            fmt::format("move or shrink it into [{}, {}, {}] to [{}, {}, {}]", domain.min_m.x, domain.min_m.y,
                        domain.min_m.z, domain.max_m.x, domain.max_m.y, domain.max_m.z));
    }
}

void describe_follows(Section& section, EmitterSettings& settings,
                      const std::vector<VehicleSettings>& vehicles)
{
    section.text({.name = "follows",
                  .about = "\"camera\" or the name of a vehicle that carries the sky along",
                  .applies = settings.emitter.shape == EmitterShape::sky,
                  .applies_when = "with shape = \"sky\""},
                 settings.follows);
    std::vector<std::string_view> names{"camera"};
    for (const VehicleSettings& vehicle : vehicles) names.push_back(vehicle.name);
    require_vehicle(section, "follows", settings.follows, names);
}

void describe_amount(Section& section, Emitter& emitter, const Scene& scene, std::uint64_t& bursts)
{
    const bool sky = emitter.shape == EmitterShape::sky;
    const bool drift = emitter.shape == EmitterShape::drift;  // its rate is the wind's
    section.number({.name = "rate_per_s",
                    .about = "drawn flakes per second, exact in the long run for any step",
                    .applies = !sky && !drift,
                    .applies_when = "with a shape other than \"sky\" and \"drift\""},
                   {.min = 0, .max = 1e12}, emitter.rate_per_s);
    section.whole(
        {.name = "burst", .about = "drawn flakes at the start; a sky keeps so many alive", .required = sky},
        {.min = 0, .max = 1e18, .allowed = "0 to particles.capacity"}, emitter.burst);
    section.require(drift || emitter.rate_per_s > 0 || emitter.burst > 0, "",
                    "makes no flakes (rate_per_s and burst are 0)",
                    "use a rate_per_s or a burst above 0, or leave the emitter out");
    const std::uint64_t room = scene.capacity - std::min(scene.capacity, bursts);
    section.require(
        emitter.burst <= room, "burst",
        fmt::format("has no room (particles.capacity is {}, emitters before this one start with {})",
                    scene.capacity, bursts),
        fmt::format("use 0 to {}, or a larger capacity", room));
    bursts += std::min(emitter.burst, room);
    section.require(
        emitter.rate_per_s * scene.step_s <= static_cast<double>(scene.capacity), "rate_per_s",
        fmt::format("has no room (a step of {} s alone makes more flakes than particles.capacity = {})",
                    scene.step_s, scene.capacity),
        fmt::format("use at most {:.0f}, or a larger capacity",
                    static_cast<double>(scene.capacity) / scene.step_s));
}

void describe_emitter(Section& section, Scene& scene, std::uint64_t& bursts)
{
    EmitterSettings settings;
    Emitter& emitter = settings.emitter;
    section.choice({.name = "shape", .about = "where flakes begin, uniformly", .required = true}, kShapes,
                   emitter.shape);
    describe_follows(section, settings, scene.vehicles);
    describe_point_and_line(section, settings);
    describe_sphere_and_box(section, settings);
    describe_plane(section, settings);
    if (emitter.shape != EmitterShape::sky) require_inside(section, settings, scene.domain);
    describe_amount(section, emitter, scene, bursts);
    emitter.at_rest_in_air =
        !section.triple({.name = "velocity_m_s",
                         .about = "at the start, over the ground; without it, that of the air plus settling"},
                        {.min = -300, .max = 300}, emitter.velocity_m_s);
    section.require(scene.emitters.size() < 255, "shape",
                    "is the 256th emitter (a flake keeps its emitter in 8 bits)", "use at most 255");
    scene.emitters.push_back(settings);
}

}  // namespace

void describe_emitters(Section& root, Scene& scene)
{
    std::uint64_t bursts = 0;
    root.sections({.name = "emitter", .about = "what makes flakes; none: the air stays empty"},
                  [&](Section& s) { describe_emitter(s, scene, bursts); });
}

}  // namespace spindrift::scene
