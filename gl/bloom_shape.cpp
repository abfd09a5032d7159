// SPDX-License-Identifier: MIT
#include "gl/bloom_shape.h"

#include <algorithm>
#include <cmath>

#include "scene/development.h"

namespace spindrift::gl
{

namespace
{

using scene::BloomMethod;

/// Variances along an axis, in pixels squared: of the mean of n pixels; of a tent that takes n pixels to one,
/// or goes linearly between texels n pixels apart, over the places of the pixels.
double box_variance(double n)
{
    return (n * n - 1) / 12;
}
double tent_variance(double n)
{
    return (2 * n * n + 1) / 12;
}

/// Of one level down and up again, in texels of the finer level, squared: 1.75 + 2.75 for 13 taps down and a
/// tent up, 0.75 + 25/12 for the dual filter. Each level counts four times as much as the one before.
constexpr double kPyramidLevel = 4.5;
constexpr double kDualLevel = 0.75 + 25.0 / 12;

double chain_variance(double of_a_level, int levels)
{
    return of_a_level * (std::pow(4.0, levels) - 1) / 3;
}

void set_gauss(BloomShape& shape, double variance_px2)
{
    shape.gauss_sigma = std::sqrt(std::max(variance_px2, 0.0)) / shape.scale;
    shape.gauss_radius = static_cast<int>(std::ceil(3 * shape.gauss_sigma));
}

void shape_reduced(BloomShape& shape)
{
    constexpr double kFewestTexels = 4;  // a Gaussian narrower than that is not sampled well
    shape.first_scale = shape.scale = 2;
    while (shape.scale < 8 && shape.sigma_px >= kFewestTexels * 2 * shape.scale) shape.scale *= 2;
    const double tent = shape.scale > 2 ? 4 * tent_variance(shape.scale / 2.0) : 0;
    set_gauss(shape, shape.sigma_px * shape.sigma_px - box_variance(2) - tent - tent_variance(shape.scale));
}

void shape_chain(BloomShape& shape, double of_a_level)
{
    shape.first_scale = shape.scale = 2;
    const double rest = shape.sigma_px * shape.sigma_px - box_variance(2) - tent_variance(2);
    while (4 * chain_variance(of_a_level, shape.levels + 1) <= rest) ++shape.levels;
    shape.scale = 2 << shape.levels;
    set_gauss(shape, rest - 4 * chain_variance(of_a_level, shape.levels));
}

}  // namespace

BloomShape bloom_shape(const scene::BloomSettings& bloom, int height_px)
{
    BloomShape shape;
    shape.sigma_px = scene::bloom_sigma_px(bloom, height_px);
    switch (bloom.method)
    {
        case BloomMethod::gaussian:
        case BloomMethod::legacy:
            set_gauss(shape, shape.sigma_px * shape.sigma_px);
            break;
        case BloomMethod::reduced:
            shape_reduced(shape);
            break;
        case BloomMethod::pyramid:
            shape_chain(shape, kPyramidLevel);
            break;
        case BloomMethod::dual:
            shape_chain(shape, kDualLevel);
            break;
    }
    return shape;
}

BloomCost bloom_cost(const scene::BloomSettings& bloom, int width_px, int height_px)
{
    const BloomShape shape = bloom_shape(bloom, height_px);
    const double pixels = static_cast<double>(width_px) * height_px;
    const auto texels = [&](double scale) { return pixels / (scale * scale); };
    BloomCost cost{pixels, texels(shape.first_scale)};
    const auto add = [&](double written, double taps)
    {
        cost.texels_written += written;
        cost.texels_read += written * taps;
    };
    if (bloom.method == BloomMethod::reduced && shape.scale > 2)
    {
        add(texels(shape.scale) * shape.scale / 2, shape.scale);
        add(texels(shape.scale), shape.scale);
    }
    const bool dual = bloom.method == BloomMethod::dual;
    for (int level = 1; level <= shape.levels; ++level)
    {
        add(texels(2 << level), 4 * (dual ? 5 : 13));
        add(texels(1 << level), 4 * (dual ? 8 : 9));
    }
    if (shape.gauss_radius > 0) add(2 * texels(shape.scale), 2 * shape.gauss_radius + 1);
    return cost;
}

}  // namespace spindrift::gl
