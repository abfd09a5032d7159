// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "image/image.h"

namespace spindrift::image
{

/// Pixels that a viewer sees in a degree: 0.7 m before a display 0.7 m wide with 3840 columns.
inline constexpr double kFlipPixelsPerDegree = 67.0206;

/// How different two pictures look to somebody who flips between them, 0 to 1, pixel by pixel and row by row
/// from the top. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", Proceedings of the
/// ACM on Computer Graphics and Interactive Techniques 3 (2020): the form for displayed pictures, sRGB.
/// Throws Error if the sizes differ.
std::vector<float> flip_map(const Image8& a, const Image8& b,
                            double pixels_per_degree = kFlipPixelsPerDegree);

/// Mean over the pixels.
double flip(const Image8& a, const Image8& b, double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace spindrift::image
