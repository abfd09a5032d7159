// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/vec.h"
#include "scene/scene.h"

namespace spindrift::bench
{

/// Flakes that hang in calm air before a camera, nothing else: what a row about drawing begins with.
struct FlakeField
{
    int flakes = 0;
    double rate_mm_h = 0, weight = 1;
    Vec3d domain_m{};
    Vec3d centre_m{}, size_m{};  ///< of the flakes
    double far_m = 100;
    Vec3d eye_m{}, look_at_m{};
    std::string sections;  ///< further ones: lights, sky, air
    std::string render;    ///< lines of its section

    scene::Scene scene() const;
};

}  // namespace spindrift::bench
