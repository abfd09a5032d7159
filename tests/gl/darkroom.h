// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// Develops pictures that a test makes up: exposure, bloom and tone alone, without a scene. Rows are as
/// given, and nothing is rounded to 8 bits or half floats on the way in and out.
struct Darkroom
{
    scene::Scene scene;
    image::Image light;
    double time_s = 0;

    Darkroom(int width, int height);

    void set(int x, int y, float red, float green, float blue);
    void fill(float grey);

    /// The spread light of every pixel, for bloom settings that spread all there is (threshold and knee 0).
    image::Image spread() const;
    /// What is shown, sRGB, in float.
    image::Image shown() const;
    /// The same in 8 bit.
    image::Image8 shown8() const;

    mutable bool found_bright = false;  ///< by the bloom of the last picture
    mutable double exposure = 0;        ///< of the last picture
};

}  // namespace spindrift::gl
