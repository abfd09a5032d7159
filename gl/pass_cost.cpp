// SPDX-License-Identifier: MIT
#include "gl/pass_cost.h"

#include <algorithm>

#include "core/glow_grid.h"
#include "gl/bloom_shape.h"

namespace spindrift::gl
{

namespace
{

constexpr double kColour = 8;  // bytes of a texel RGBA16F
constexpr double kDepth = 4;
constexpr double kDisplay = 4;
constexpr double kPair = 8;    // of the draw list
constexpr double kPlace = 12;  // three floats of a flake
constexpr double kId = 4;
constexpr double kFate = 4;
constexpr double kNode = 4;  // of a grid of glow
constexpr double kCell = 4;  // of the snow's slices

/// `elements` of so many bytes, read and written.
PassCost touching(double elements, double bytes)
{
    return {elements * bytes * 1e-6, elements * 1e-6};
}

PassCost bloom_pass_cost(const scene::BloomSettings& bloom, const View& view)
{
    const BloomCost texels = bloom_cost(bloom, view.width_px, view.height_px);
    return {(texels.texels_read + texels.texels_written) * kColour * 1e-6, texels.texels_read * 1e-6};
}

}  // namespace

PassCost pass_cost(std::string_view pass, const scene::Scene& scene, const View& view, const FrameStats& last)
{
    const double pixels = static_cast<double>(view.width_px) * view.height_px;
    const auto alive = static_cast<double>(last.counts.alive);
    const double drawn = last.drawn > 0 ? static_cast<double>(last.drawn) : alive;
    const double sort_passes = scene.render.depth_bits == 32 ? 3 : 2;  // of the radix sort
    if (pass == "cull") return touching(alive, kPlace + kFate + kPair);
    if (pass == "sort") return touching(drawn, kPair * (1 + 2 * sort_passes));
    const auto casters = static_cast<double>(std::count_if(
        scene.lights.begin(), scene.lights.end(), [](const scene::Light& light) { return light.shadow; }));
    if (pass == "shadows") return touching(casters * scene.shadows.map_px * scene.shadows.map_px, kDepth);
    if (pass == "snow shade")
    {
        const double texels = casters * scene.shadows.snow_px * scene.shadows.snow_px;
        const PassCost flakes = touching(casters * alive, kPlace + kId + kFate + 4 * kCell),
                       sums = touching(texels * scene.shadows.snow_slices, 2 * kCell + kDepth);
        return {flakes.megabytes + sums.megabytes, flakes.million_elements + sums.million_elements};
    }
    if (pass == "scene") return touching(pixels, kColour + kDepth);
    if (pass == "sky") return touching(pixels, kColour + kDepth);
    if (pass == "glow grids")
    {
        const double nodes = static_cast<double>(scene.lights.size()) * GlowGrid::count();
        return touching(nodes, kNode);
    }
    if (pass == "fog") return touching(pixels, 2 * kColour + 3 * kDepth);
    if (pass == "fade") return touching(pixels, 3 * kDepth);
    if (pass == "flakes") return touching(drawn, kPlace + kId + kPair);
    if (pass == "tiles")
    {
        const PassCost light = touching(pixels, 2 * kColour + kDepth),
                       flakes = touching(drawn, kPlace + kId + kPair);
        return {light.megabytes + flakes.megabytes, light.million_elements + flakes.million_elements};
    }
    if (pass == "exposure") return touching(pixels / 16, kColour);
    if (pass == "bloom") return bloom_pass_cost(scene.bloom, view);
    if (pass == "tone") return touching(pixels, kColour + kDisplay);
    return {};
}

}  // namespace spindrift::gl
