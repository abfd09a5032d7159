// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "core/staggered_wind.h"

namespace spindrift::scene
{

/// Name of a wind that is still to be projected: a hash of its grid, solids and faces.
std::string wind_key(const StaggeredWind& wind);

/// Takes the faces from a file of write_cached(). False: there is none. Throws Error if there is one that
/// does not hold a wind of this grid.
bool read_cached(const std::filesystem::path& file, StaggeredWind& wind);

/// Keeps the faces (single precision); makes the folder if it is missing.
void write_cached(const std::filesystem::path& file, const StaggeredWind& wind);

}  // namespace spindrift::scene
