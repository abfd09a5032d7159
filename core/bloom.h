// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/math.h"
#include "core/vec.h"

namespace spindrift
{

// Bloom: what of the light is bright, and how far it spreads (docs/drawing.md). shaders/bright_part.glsl
// mirrors the templates.

/// What a pixel counts as: NaN and negative light are none, infinity is the largest half float. A pixel that
/// went wrong stays one pixel.
template <class R>
SPINDRIFT_HD Vec3<R> contained(const Vec3<R>& c)
{
    const auto part = [](R v) { return select(v > number<R>(0), min(v, number<R>(65504)), number<R>(0)); };
    return {part(c.x), part(c.y), part(c.z)};
}

/// In exposed light, where 1 is white.
template <class R>
struct Bright
{
    R threshold{1};
    R knee{0};       ///< half width over which it sets in, as a share of the threshold, 0 to 1
    R ceiling{100};  ///< a pixel counts up to here, so that one hot pixel is no lamp
};

/// The part of exposed light that is above the threshold: the brightest channel decides, hue is kept. Between
/// threshold (1 - knee) and threshold (1 + knee) a parabola joins nothing to the straight line.
template <class R>
SPINDRIFT_HD Vec3<R> bright_part(const Vec3<R>& c, const Bright<R>& bright)
{
    const R zero = number<R>(0);
    const R tiny = number<R>(1e-10);
    const R given = max(c.x, max(c.y, c.z));
    const R value = min(given, bright.ceiling);
    const R width = bright.threshold * bright.knee;
    const R soft = clamp(value - bright.threshold + width, zero, width + width);
    const R above = max(soft * soft / max(number<R>(4) * width, tiny), value - bright.threshold);
    return c * (max(above, zero) / max(given, tiny));
}

/// The report's, (C - t) / (1 - t) by channel, under the same ceiling; held to the light that is there, and
/// for thresholds up to 1, where it has a pole.
template <class R>
SPINDRIFT_HD Vec3<R> report_bright_part(const Vec3<R>& c, const Bright<R>& bright)
{
    const R given = max(c.x, max(c.y, c.z));
    const R counted = min(given, bright.ceiling) / max(given, number<R>(1e-10));
    const R per = number<R>(1) / max(number<R>(1) - bright.threshold, number<R>(1e-3));
    const auto part = [&](const R& v)
    { return clamp((v * counted - bright.threshold) * per, number<R>(0), v * counted); };
    return {part(c.x), part(c.y), part(c.z)};
}

/// Weights of a Gaussian at 0, 1 ... radius, so that the sum from -radius to radius is 1. sigma > 0, or 0 for
/// no spread. Truth and gl::BloomPass share them.
inline std::vector<double> gaussian_weights(double sigma, int radius)
{
    std::vector<double> weights(static_cast<std::size_t>(radius) + 1, 0.0);
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
        const double x = static_cast<double>(i) / (sigma > 0 ? sigma : 1e-9);
        weights[i] = exp(-0.5 * x * x);
        sum += i == 0 ? weights[i] : 2 * weights[i];
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

}  // namespace spindrift
