// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "scene/wind_slice.h"

namespace spindrift::scene
{

/// Reads the text files of QUIC-URB and QUIC-Plume that the ancestors of this program ran on:
///  - QU_velocity.dat: "% ..." lines, number of time steps, then for each its number, its time in decimal
///    hours, and a line x y z u v w for every cell, x fastest, one layer of cells under the ground first;
///  - QU_celltype.dat in the same folder: x y z kind for the same cells; 0 is solid;
///  - QP_turbfield.dat, if named: a header of five lines that gives I, J, K, then x y z and SIGU SIGV SIGW LZ
///    LEFF EPS UV UW VW for every cell above the ground. The three sigmas count along the local wind, the
///    covariances in the axes of the grid; both are kept as they are, and C0 eps = 5.7 EPS.
/// Velocities of cells become velocities of faces: the mean of the two cells, the cell's own at the border.
/// Throws Error naming file, line and reason.
std::vector<WindSlice> read_quic_files(const std::filesystem::path& velocity,
                                       const std::filesystem::path& turbulence);

}  // namespace spindrift::scene
