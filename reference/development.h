// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.h"
#include "scene/scene.h"

namespace spindrift::reference
{

// What gl::Renderer makes of its float target, in double precision: docs/drawing.md, "Development".

/// The factor on all light: the scene's, or what shows the log-average of every pixel as its grey.
double exposure_of(const image::Image& linear, const scene::RenderSettings& render);

/// What is bright of exposed light.
image::Image bright_picture(const image::Image& linear, double exposure, const scene::BloomSettings& bloom);

/// Blurred by a Gaussian that is cut at 6 sigma; outside of the picture there is no light.
image::Image exact_gaussian(const image::Image& picture, double sigma_px);

/// The 8-bit picture; never dithered.
image::Image8 develop(const image::Image& linear, const scene::Scene& scene);

}  // namespace spindrift::reference
