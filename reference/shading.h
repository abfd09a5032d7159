// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/light.h"
#include "core/vec.h"
#include "core/view.h"
#include "reference/ray_scene.h"
#include "reference/shadows.h"
#include "scene/air.h"
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

/// The light that a flake sends to the eye.
struct FlakeLight
{
    Rgb ambient{};
    Rgb lamps{};      ///< before the sphere imposter
    Vec3d towards{};  ///< unit, to the luminance-weighted mean of the lamps: right, up, towards the viewer; 0
                      ///< without lamps
};

/// What lights flakes, fog and surfaces at one display time.
struct Lighting
{
    Lights lights;
    Rgb ambient{};        ///< of surfaces
    Rgb flake_ambient{};  ///< of flakes and fog
    AirLayers<double> air;
    const Shadows* shadows = nullptr;  ///< none: every lamp reaches everything

    /// Share of a lamp's light that gets past what stands between.
    double reaches(std::size_t lamp, const Vec3d& place) const
    {
        return shadows == nullptr ? 1 : shadows->share(lamp, place);
    }
};
Lighting lighting_at(const scene::Scene& scene, const scene::Geometry& geometry, const scene::Air& air,
                     double time_s);

FlakeLight flake_light(const Lighting& lighting, const View& view, const Vec3d& flake);

/// What a surface that is met at a place sends back along the ray; `to_eye` is a unit vector.
Rgb surface_radiance(const Lighting& lighting, const Hit& hit, const Vec3d& place, const Vec3d& to_eye);

/// What the air before a thing adds to its light, and the share of it that it lets through.
struct AirView
{
    Rgb glow{};
    double clear = 1;
};

/// Of `distance_m` along a unit way from the eye.
AirView air_before(const scene::Scene& scene, const scene::Air& air, const Lighting& lighting,
                   const View& view, const Vec3d& way, double distance_m);

}  // namespace spindrift::reference
