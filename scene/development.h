// SPDX-License-Identifier: MIT
#pragma once

#include "core/bloom.h"
#include "core/tone.h"
#include "scene/scene.h"

namespace spindrift::scene
{

// What the settings of a scene mean to the formulas of core/.

Tone<double> tone_of(const Scene& scene);
Bright<double> bright_of(const BloomSettings& bloom);
/// Of the bloom's Gaussian in a picture of that height.
double bloom_sigma_px(const BloomSettings& bloom, int height_px);

/// What a pixel sends out and what the display gives off for it, cd/m2.
struct PixelLuminance
{
    double scene_cd_m2 = 0, display_cd_m2 = 0;
};
/// `light` as rendered, `shown` as 8-bit sRGB. The display must be calibrated (unit_cd_m2 above 0).
PixelLuminance pixel_luminance(const DisplaySettings& display, const float* light,
                               const unsigned char* shown);

}  // namespace spindrift::scene
