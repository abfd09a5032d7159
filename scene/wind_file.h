// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "core/staggered_wind.h"
#include "scene/flow_field.h"

namespace spindrift::scene
{

/// What a pair of files of QES-Winds says: the lowest corner of its fluid layers is the lowest corner of the
/// domain.
struct WindFile
{
    StaggeredWind wind;                 ///< as in the file; buildings and terrain are solid
    std::vector<Stress<float>> stress;  ///< as in the file, cell-centred; empty without a turbulence file
    std::vector<float> c0_eps;
};

/// Reads the first time slice of *_windsWk.nc (face-centred, one ghost layer of cells under the ground, which
/// is left out) and, if named, of *_turbOut.nc. Layers of unequal thickness are interpolated to the thinnest.
/// Throws Error with file, variable and reason: missing, not NetCDF, cut off, a variable missing or of the
/// wrong shape, numbers that are not finite, cells that are not regular.
WindFile read_wind_file(const std::filesystem::path& winds, const std::filesystem::path& turbulence);

}  // namespace spindrift::scene
