// SPDX-License-Identifier: MIT
#pragma once

#include "core/air.h"
#include "core/view.h"
#include "scene/flake_shade.h"
#include "scene/scene.h"

namespace spindrift::scene
{

/// The air of a scene as drawing sees it, local frame.
struct Air
{
    AirLayers<double> layers;
    bool tiny_flakes_fade = false;  ///< fog stands for flakes below a third of a pixel
    FogLaw law = FogLaw::exponential;
    double visibility_share = 1;  ///< law = legacy: visibility over 600 m

    // The sky whose flakes hide a part of it; flakes_per_m3 = 0: none.
    double flakes_per_m3 = 0;
    Vec3d low{}, high{};  ///< of the flakes' volume at the time asked for
    FlakeShadeTable shade;

    bool thick() const { return layers.uniform_per_m > 0 || layers.drift_per_m > 0; }
    FlakeVolume<double> volume() const { return {low, high, flakes_per_m3, shade.view()}; }
};

/// Where flakes are at a time, local frame: the sky's box if nothing else emits, else the domain.
struct FlakeBox
{
    Vec3d low, high;
};
FlakeBox flake_box(const Scene& scene, double time_s);

/// Extinction of the snowfall, 1/m, whatever way it is stated; without the drift.
double uniform_extinction(const Scene& scene);

/// Extinction of the drawn flakes of the sky at full size, 1/m, where they begin.
double flake_extinction(const Scene& scene);

/// With the drift, local frame.
AirLayers<double> layers_of(const Scene& scene);

/// Least transmittance of the air from the eye to the far plane, over the ways that the picture shows: level
/// and along its corners.
double far_transmittance(const Scene& scene, const View& view);

/// The air for a frame. The table of the flakes' shade is made anew: keep it while the lens stays
/// (same_lens).
Air air_at(const Scene& scene, const View& view, double time_s);
/// Only the flakes' volume moves, and with it their density where ground or domain cut it.
void move_volume(Air& air, const Scene& scene, double time_s);
bool same_lens(const View& a, const View& b);

}  // namespace spindrift::scene
