// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/air.h"
#include "core/view.h"
#include "core/world.h"
#include "scene/scene.h"

namespace spindrift::scene
{

/// Owner of a FlakeShade: what a drawn flake hides on average, by its depth along the view.
struct FlakeShadeTable
{
    static constexpr int kEntries = 256;

    std::vector<double> area_m2, integral_m3;
    double first_log2 = 0, entries_per_log2 = 1;

    FlakeShade<double> view() const
    {
        return {area_m2.data(), integral_m3.data(), static_cast<int>(area_m2.size()), first_log2,
                entries_per_log2};
    }
};

/// Mean over the spectrum, the crystals and the sprite of the flake's alpha times the area that it is drawn
/// on, m2, as docs/drawing.md "Its sprite" draws it at this depth with fade-out of tiny flakes.
double flake_area_m2(const RenderSettings& render, const Snow& snow, const View& view, double depth_m);

/// The same for flakes of any size on the picture: neither too small, too large nor too near.
double full_flake_area_m2(const RenderSettings& render, const Snow& snow);

/// Area that a drawn flake hides over the square of its radius, neither too small, too large nor too near:
/// mean over the crystals. 0 for additive ones.
double flake_cover(const RenderSettings& render, const Snow& snow);

/// Tabulated from the near to the far plane; nowhere more than `most_m2`.
FlakeShadeTable make_flake_shade(const RenderSettings& render, const Snow& snow, const View& view,
                                 double most_m2);

}  // namespace spindrift::scene
