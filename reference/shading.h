// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/light.h"
#include "core/vec.h"
#include "core/view.h"
#include "reference/ray_scene.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::reference
{

/// Linear Rec.709 in double.
using Rgb = Vec3d;

Rgb rgb(const scene::Colour& colour);
Vec3d wide(const Vec3f& v);

/// The lamps that shine at one display time.
using Lights = std::vector<Lamp<double>>;
Lights lights_at(const scene::Scene& scene, const scene::Geometry& geometry, double time_s);

/// The light that a flake sends to the eye.
struct FlakeLight
{
    Rgb ambient{};
    Rgb lamps{};      ///< before the sphere imposter
    Vec3d towards{};  ///< unit, to the luminance-weighted mean of the lamps: right, up, towards the viewer; 0
                      ///< without lamps
};

FlakeLight flake_light(const Lights& lights, const scene::SkySettings& sky, const View& view,
                       const Vec3d& flake);

/// What a surface that is met at a place sends back along the ray; `to_eye` is a unit vector.
Rgb surface_radiance(const Lights& lights, const scene::SkySettings& sky, const Hit& hit, const Vec3d& place,
                     const Vec3d& to_eye);

}  // namespace spindrift::reference
