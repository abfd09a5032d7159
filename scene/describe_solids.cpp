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

constexpr std::array<Named<GroundKind>, 3> kGrounds{
    {{GroundKind::none, "none"}, {GroundKind::plane, "plane"}, {GroundKind::height_field, "height-field"}}};
constexpr std::array<Named<Contact>, 3> kContacts{
    {{Contact::land, "land"}, {Contact::bounce, "bounce"}, {Contact::vanish, "vanish"}}};
enum class UpAxis
{
    y,
    z
};
constexpr std::array<Named<UpAxis>, 2> kUpAxes{{{UpAxis::y, "y"}, {UpAxis::z, "z"}}};

constexpr Range kShare{.min = 0, .max = 1};
constexpr Range kRadiance{.min = 0, .max = 1e9};

/// 2 B a voxel: 268 MB.
constexpr double kMostVoxels = 128.0 * 1024 * 1024;

void describe_surface(Section& section, Surface& surface, bool applies, std::string_view applies_when)
{
    section.choice({.name = "contact",
                    .about = "a flake that touches it comes to rest, is thrown back, or is gone",
                    .applies = applies,
                    .applies_when = applies_when},
                   kContacts, surface.contact);
    section.number({.name = "restitution",
                    .about = "share of the speed towards the surface that a bounce keeps",
                    .applies = applies && surface.contact == Contact::bounce,
                    .applies_when = "with contact = \"bounce\""},
                   kShare, surface.restitution);
}

void describe_ground(Section& section, GroundSettings& ground, const DomainSettings& domain)
{
    section.choice({.name = "kind", .about = "nothing, a level plane, or a height field"}, kGrounds,
                   ground.kind);
    const bool any = ground.kind != GroundKind::none;
    const bool field = ground.kind == GroundKind::height_field;
    constexpr std::string_view kAny = "with kind = \"plane\" or \"height-field\"";
    constexpr std::string_view kField = "with kind = \"height-field\"";
    section.number({.name = "height_m",
                    .about = "of the plane; of black in a height field",
                    .applies = any,
                    .applies_when = kAny},
                   kCoordinate, ground.height_m);
    section.require(!any || ground.height_m < domain.max_m.z, "height_m",
                    "is not below the top of the domain (flakes would have no room)",
                    "use less than domain.max_m's z");
    section.file({.name = "file",
                  .about = "grey PNG of 8 or 16 bit that spans the domain, its first row at the largest y",
                  .required = true,
                  .applies = field,
                  .applies_when = kField},
                 ground.file);
    section.number({.name = "relief_m",
                    .about = "height of white above black",
                    .applies = field,
                    .applies_when = kField},
                   {.min = 0, .max = 1e4}, ground.relief_m);
    describe_surface(section, ground.surface, any, kAny);
    section.triple({.name = "albedo",
                    .about = "share of light given back: red, green, blue, linear",
                    .applies = any,
                    .applies_when = kAny},
                   kShare, ground.albedo);
}

void describe_box(Section& section, std::vector<BoxSettings>& boxes)
{
    BoxSettings box;
    section.triple({.name = "min_m", .about = "lower corner", .required = true}, kCoordinate, box.min_m);
    section.triple({.name = "max_m", .about = "upper corner", .required = true}, kCoordinate, box.max_m);
    const Vec3d size = box.max_m - box.min_m;
    section.require(std::min({size.x, size.y, size.z}) > 0, "max_m",
                    "is not above min_m (the box has no inside)", "use max_m above min_m on each axis");
    describe_surface(section, box.surface, true, {});
    section.triple({.name = "albedo", .about = "share of light given back: red, green, blue, linear"}, kShare,
                   box.albedo);
    section.triple({.name = "emission_w_sr_m2", .about = "radiance of its own: red, green, blue"}, kRadiance,
                   box.emission);
    boxes.push_back(box);
}

void describe_model(Section& section, std::vector<ModelSettings>& models,
                    const std::vector<VehicleSettings>& vehicles)
{
    ModelSettings model;
    section.file(
        {.name = "file", .about = "OBJ, glTF 2 or what else assimp reads, in metres", .required = true},
        model.file);
    section.triple({.name = "position_m", .about = "where its origin stands"}, kCoordinate, model.position_m);
    section.number({.name = "yaw_deg", .about = "turn about the vertical, counter-clockwise seen from above"},
                   {.min = -360, .max = 360}, model.yaw_deg);
    section.number({.name = "scale", .about = "metres of the scene per unit of the file"},
                   {.min = 1e-6, .max = 1e6, .why = "a model of no size has no surface"}, model.scale);
    UpAxis up = UpAxis::y;
    section.choice({.name = "up_axis", .about = "axis of the file that points up"}, kUpAxes, up);
    model.y_up = up == UpAxis::y;
    describe_vehicle_reference(section, "drawn at the place of that vehicle; flakes pass through it",
                               model.vehicle, vehicles);
    const bool free = model.vehicle.empty();
    section.flag(
        {.name = "solid", .about = "flakes meet it", .applies = free, .applies_when = "without vehicle"},
        model.solid);
    model.solid = model.solid && free;
    describe_surface(section, model.surface, model.solid, "with solid = true and without vehicle");
    models.push_back(model);
}

void describe_voxels(Section& section, Scene& scene)
{
    section.number({.name = "size_m", .about = "edge of the voxels into which solids are cut for contacts"},
                   {.min = 0.01, .max = 1000}, scene.voxel_m);
    const auto solid = [](const ModelSettings& model) { return model.solid; };
    const bool any = !scene.boxes.empty() || scene.ground.kind == GroundKind::height_field ||
                     std::any_of(scene.models.begin(), scene.models.end(), solid);
    const Vec3d size = scene.domain.max_m - scene.domain.min_m;
    const double voxels = std::ceil(size.x / scene.voxel_m) * std::ceil(size.y / scene.voxel_m) *
                          std::ceil(size.z / scene.voxel_m);
    section.require(
        !any || voxels <= kMostVoxels, "size_m",
        fmt::format("gives {:.3g} voxels in this domain (at 2 B each {:.1f} GB)", voxels, voxels * 2e-9),
        fmt::format("use a larger size, at most {:.0f} voxels", kMostVoxels));
}

}  // namespace

void describe_solids(Section& root, Scene& scene)
{
    root.section(
        {.name = "ground", .about = "what lies under the snowfall; a level plane unless said otherwise"},
        [&](Section& s) { describe_ground(s, scene.ground, scene.domain); });
    root.sections({.name = "box", .about = "solid boxes along the axes"},
                  [&](Section& s) { describe_box(s, scene.boxes); });
    root.sections({.name = "model", .about = "models from files"},
                  [&](Section& s) { describe_model(s, scene.models, scene.vehicles); });
    root.section({.name = "voxels", .about = "how finely flakes feel solids"},
                 [&](Section& s) { describe_voxels(s, scene); });
}

}  // namespace spindrift::scene
