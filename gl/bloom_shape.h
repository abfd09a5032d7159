// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.h"

namespace spindrift::gl
{

/// How a chain of passes makes up a Gaussian of one standard deviation. Pure: tests and the frame plan call
/// it without GL.
struct BloomShape
{
    double sigma_px = 0;     ///< wanted, in pixels of the picture
    int first_scale = 1;     ///< pixels of the picture per texel of the bright part: 1 or 2, each way
    int scale = 1;           ///< pixels per texel where the Gaussian runs
    int levels = 0;          ///< halvings from first_scale to scale (pyramid, dual)
    double gauss_sigma = 0;  ///< of the Gaussian that runs there, in its texels; 0: none
    int gauss_radius = 0;    ///< taps to each side
};

/// For a picture of that height.
BloomShape bloom_shape(const scene::BloomSettings& bloom, int height_px);

/// Texels that the whole chain reads and writes for a picture, for the estimate of a frame plan.
struct BloomCost
{
    double texels_read = 0, texels_written = 0;
};
BloomCost bloom_cost(const scene::BloomSettings& bloom, int width_px, int height_px);

}  // namespace spindrift::gl
