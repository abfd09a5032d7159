// SPDX-License-Identifier: MIT
#include "scene/describe_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "scene/nearest_name.h"

namespace spindrift::scene
{
namespace
{

constexpr std::array<Named<OnLeave>, 3> kOnLeave{
    {{OnLeave::remove, "remove"}, {OnLeave::respawn, "respawn"}, {OnLeave::wrap, "wrap"}}};

void describe_name(Section& section, Scene& scene)
{
    section.text({.name = "name", .about = "short title"}, scene.name);
    section.text({.name = "about", .about = "what there is to see"}, scene.about);
    section.whole(
        {.name = "seed", .about = "of everything random; the same seed gives the same run, bit for bit"},
        {.min = 0, .max = 9.2e18, .allowed = "0 to 9.2e18"}, scene.seed);
    section.number({.name = "step_s", .about = "length of a time step"},
                   {.min = 1e-4, .max = 10, .why = "shorter steps gain nothing, longer ones blur the wind"},
                   scene.step_s);
}

void describe_domain(Section& section, DomainSettings& domain)
{
    section.triple({.name = "min_m",
                    .about = "lower corner of the box in which flakes live, world frame, z up",
                    .required = true},
                   kCoordinate, domain.min_m);
    section.triple({.name = "max_m", .about = "upper corner", .required = true}, kCoordinate, domain.max_m);
    const Vec3d size = domain.max_m - domain.min_m;
    const double least = std::min({size.x, size.y, size.z});
    section.require(least >= 0.01, "max_m",
                    "is not above min_m in x, y and z (a domain without inside holds no flake)",
                    "use max_m at least 0.01 above min_m on each axis");
    section.require(std::max({size.x, size.y, size.z}) <= kLargestDomain, "max_m",
                    "is too far from min_m (single precision resolves no better than 8 mm at the far end)",
                    "use at most 100000 m along each axis");
    section.choice(
        {.name = "on_leave",
         .about = "flakes that cross the border: are gone, are made anew by their emitter, or come in again "
                  "on the opposite side (x and y; top and bottom remove)"},
        kOnLeave, domain.on_leave);
}

void describe_particles(Section& section, std::uint64_t& capacity)
{
    section.whole({.name = "capacity",
                   .about = "room for so many drawn flakes at once, fixed for the run",
                   .required = true},
                  {.min = 1, .max = 1e18, .allowed = "1 to 4294967295, as far as memory goes (60 B a flake)"},
                  capacity);
}

void describe_simulation(Section& section, std::uint32_t& reorder_every_steps)
{
    std::uint64_t steps = reorder_every_steps;
    section.whole(
        {.name = "reorder_every_steps",
         .about = "steps after which flakes are put in the order of the wind cells that they read, so "
                  "that neighbours in memory read the same ones; 0: never; the result is the same; "
                  "also --reorder"},
        {.min = 0, .max = 1e6, .allowed = "0 to 1000000"}, steps);
    reorder_every_steps = static_cast<std::uint32_t>(steps);
}

void describe_vehicle(Section& section, std::vector<VehicleSettings>& vehicles)
{
    VehicleSettings vehicle;
    section.text(
        {.name = "name", .about = "by which emitters, models and lights refer to it", .required = true},
        vehicle.name);
    const auto same = [&](const VehicleSettings& other) { return other.name == vehicle.name; };
    section.require(!vehicle.name.empty() && vehicle.name != "camera", "name",
                    "does not name a vehicle (empty means none, and \"camera\" is the camera)",
                    "use another name");
    section.require(std::none_of(vehicles.begin(), vehicles.end(), same), "name",
                    "names a second vehicle (references would be ambiguous)", "use each name once");
    describe_path(section, "where it is, piecewise linear in time, held at both ends", vehicle.path.keys,
                  [](Section& key_section, VehicleSettings::Key& key)
                  {
                      key_section.triple(
                          {.name = "position_m", .about = "its place, world frame", .required = true},
                          kCoordinate, key.position_m);
                  });
    section.require(!vehicle.path.keys.empty(), "key", "is empty (the vehicle is nowhere)",
                    "give at least one [[vehicle.key]]");
    vehicles.push_back(vehicle);
}

}  // namespace

void require_vehicle(Section& section, std::string_view key, std::string_view name,
                     std::span<const std::string_view> names)
{
    if (name.empty() || std::find(names.begin(), names.end(), name) != names.end()) return;
    const std::string_view nearest = nearest_name(name, names);
    section.require(false, key,
                    nearest.empty() ? "names no vehicle of this scene (a [[vehicle]] must have that name)"
                                    : fmt::format("names no vehicle of this scene (nearest: {})", nearest),
                    names.empty() ? "add a [[vehicle]]" : "use " + listed(names));
}

void describe_vehicle_reference(Section& section, std::string_view about, std::string& name,
                                const std::vector<VehicleSettings>& vehicles)
{
    section.text({.name = "vehicle", .about = about}, name);
    std::vector<std::string_view> names;
    for (const VehicleSettings& vehicle : vehicles) names.push_back(vehicle.name);
    require_vehicle(section, "vehicle", name, names);
}

void describe_scene(Section& root, Scene& scene)
{
    root.section({.name = "scene", .about = "the run as a whole"},
                 [&](Section& s) { describe_name(s, scene); });
    root.section({.name = "domain", .about = "where flakes live", .required = true},
                 [&](Section& s) { describe_domain(s, scene.domain); });
    root.section({.name = "particles", .about = "how many flakes there is room for", .required = true},
                 [&](Section& s) { describe_particles(s, scene.capacity); });
    root.section({.name = "simulation", .about = "how it is computed"},
                 [&](Section& s) { describe_simulation(s, scene.reorder_every_steps); });
    describe_air(root, scene);
    root.sections({.name = "vehicle", .about = "moving points that snow, models and lights may follow"},
                  [&](Section& s) { describe_vehicle(s, scene.vehicles); });
    describe_emitters(root, scene);
    describe_solids(root, scene);
    describe_fog(root, scene);
    describe_looks(root, scene);
}

}  // namespace spindrift::scene
