// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid_size.h"
#include "core/vec.h"

namespace spindrift::scene
{

/// Turns `cells` (0: solid, else empty) into the Chebyshev distance in cells to the nearest solid one, capped
/// at 255. Outside the grid nothing is solid. Exact: two chamfer passes over the 26 neighbours.
void chebyshev_distance(GridSize size, std::span<std::uint8_t> cells);

/// Euclidean distance (m) between the centres of each cell and the nearest solid one; infinite if nothing is
/// solid. Felzenszwalb & Huttenlocher 2012, one axis after the other.
std::vector<float> euclidean_distance(GridSize size, Vec3d cell_m, std::span<const std::uint8_t> solid);

}  // namespace spindrift::scene
