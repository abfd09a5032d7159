// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/staggered_wind.h"
#include "core/turbulence.h"

namespace spindrift::scene
{

/// What the files of a wind model say for one time: the lowest corner of their fluid layers is the lowest
/// corner of the domain.
struct WindSlice
{
    double time_s = 0;                  ///< since the first slice
    StaggeredWind wind;                 ///< as in the file; buildings and terrain are solid
    std::vector<Stress<float>> stress;  ///< as in the file, cell-centred; empty without a turbulence file
    std::vector<float> c0_eps;          ///< m2/s3, one a cell where there is stress
};

/// The most cells that a wind file may give: at 64 bytes a cell 4 GB.
inline constexpr double kMostFileCells = 1 << 26;

}  // namespace spindrift::scene
