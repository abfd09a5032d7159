// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "scene/make_world.h"

namespace spindrift::scene
{

/// Writes a wind as one NetCDF-4 file that three kinds of readers understand: QES-Plume takes it as its winds
/// file and, if there is turbulence, as its turbulence file too (layout of *_windsWk.nc and *_turbOut.nc: one
/// layer of cells under the ground, faces and cells counted from the lower corner); ParaView and xarray find
/// cell-centred velocities by the CF conventions; `source = "file"` reads it back. `origin_m`: of the file's
/// coordinates in the world frame, kept as an attribute.
void write_wind(const std::filesystem::path& file, const GriddedWind& wind, Vec3d origin_m);

}  // namespace spindrift::scene
