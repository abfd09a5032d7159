// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.h"

namespace spindrift::image
{

struct Difference
{
    double relative_l2 = 0;       ///< |a - b| / |b| over RGB in linear light
    double worst = 0;             ///< largest |a - b| of a channel
    double share_above = 0;       ///< share of pixels with a channel that differs by more than `tolerance`
    double rest_relative_l2 = 0;  ///< relative_l2 without the pixels that share_above counts
};

/// Compares RGB of two pictures of one size, `b` being the truth. A NaN on either side is an infinite
/// difference. `worst` and `tolerance` are in linear light for Image and in levels of 0..255 for Image8.
/// Throws Error if the sizes differ.
Difference compare(const Image& a, const Image& b, double tolerance);
Difference compare(const Image8& a, const Image8& b, int tolerance_levels);

/// Throws Error unless two pictures can be compared.
void require_same_size(int width_a, int height_a, int width_b, int height_b);

}  // namespace spindrift::image
