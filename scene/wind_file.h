// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "scene/wind_slice.h"

namespace spindrift::scene
{

/// Reads every time slice of a wind model's files, at least one, in the order of time:
///  - *_windsWk.nc of QES-Winds (face-centred, one ghost layer of cells under the ground, which is left out)
///    and, if named, *_turbOut.nc. Layers of unequal thickness are interpolated to the thinnest;
///  - the text files of QUIC, where `winds` ends in .dat (scene/quic_files.h).
/// Throws Error with file, variable and reason: missing, not NetCDF, cut off, a variable missing or of the
/// wrong shape, numbers that are not finite, cells that are not regular, times that do not rise, solids that
/// change with time.
std::vector<WindSlice> read_wind_file(const std::filesystem::path& winds,
                                      const std::filesystem::path& turbulence);

}  // namespace spindrift::scene
