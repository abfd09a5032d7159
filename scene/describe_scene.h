// SPDX-License-Identifier: MIT
#pragma once

#include "core/flake.h"
#include "scene/scene.h"
#include "scene/section.h"

namespace spindrift::scene
{

/// Names every key of a scene file to `root` once: what it is, its unit (in the name), range, default (what
/// the fresh `scene` holds), when it counts, and the rules between keys. Reading a file fills `scene`.
void describe_scene(Section& root, Scene& scene);

// Its parts, one table of the file each.
void describe_air(Section& root, Scene& scene);          ///< snow, wind
void describe_emitters(Section& root, Scene& scene);     ///< after domain, particles and vehicles
void describe_solids(Section& root, Scene& scene);       ///< ground, boxes, models, voxels
void describe_fog(Section& root, Scene& scene);          ///< air; after emitters and ground
void describe_looks(Section& root, Scene& scene);        ///< lights, sky, camera, render, bloom, display
void describe_development(Section& root, Scene& scene);  ///< bloom, display: from light to what is shown

/// The keys of [render] that say how light is exposed.
void describe_exposure(Section& section, RenderSettings& render);

/// Coordinates in the world frame (m).
inline constexpr Range kCoordinate{
    .min = -1e8, .max = 1e8, .why = "no place on Earth is farther from an origin"};

/// Longest edge of a domain, m: places in it are single precision from its lower corner.
inline constexpr double kLargestDomain = 1e5;

/// Bytes that one flake takes: state and draw list (core/flake.h).
inline constexpr double kBytesPerFlake = kStateBytesPerFlake + kDrawListBytesPerFlake;
static_assert(kBytesPerFlake == 60, "messages and docs/scenes.md say 60 B");

/// Throws at `key` unless `name` is empty or among `names`.
void require_vehicle(Section& section, std::string_view key, std::string_view name,
                     std::span<const std::string_view> names);

/// A key `vehicle` that names a vehicle of the scene or none.
void describe_vehicle_reference(Section& section, std::string_view about, std::string& name,
                                const std::vector<VehicleSettings>& vehicles);

/// [[key]] with time_s, in ascending order, and the places that `describe_places` names: a path in time.
template <class Key_, class Describe>
void describe_path(Section& section, std::string_view about, std::vector<Key_>& keys,
                   const Describe& describe_places)
{
    section.sections({.name = "key", .about = about, .required = true},
                     [&](Section& key_section)
                     {
                         Key_ key{};
                         key_section.number(
                             {.name = "time_s",
                              .about = "when, from the start of the run; each later than the one before"},
                             {.min = 0, .max = 1e6}, key.time_s);
                         key_section.require(keys.empty() || key.time_s > keys.back().time_s, "time_s",
                                             "is not later than the key before it (a path runs forward)",
                                             "use ascending times");
                         describe_places(key_section, key);
                         keys.push_back(key);
                     });
}

}  // namespace spindrift::scene
