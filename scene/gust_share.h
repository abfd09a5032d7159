// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "scene/flow_field.h"

namespace spindrift::scene
{

/// How far gusts are felt.
struct GustReach
{
    double length_m = 60;  ///< of the longest waves; walls are felt within a quarter of it
    double reference_height_m = 10;
    double roughness_m = 0.1;
    double ground_m = 0;
};

/// Of each cell's gusts: with the logarithmic wind from 0 at the ground over 1 at the reference height to at
/// most 1.5, linearly down to 0 at walls, 0 in solids (Wind::gust_share).
std::vector<float> gust_share(const FlowField& flow, const GustReach& reach);

/// Mean of the air of the layer of cells at a height, m/s; 0 if it has none.
Vec3f mean_at(const FlowField& flow, double height_m);

}  // namespace spindrift::scene
