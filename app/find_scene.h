// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace spindrift::app
{

/// Folders in which shipped scenes lie, those that exist: ./scenes, the source tree's, the installed ones.
std::vector<std::filesystem::path> scene_folders();

/// Every scene of these folders, by name; the first folder that has a name wins.
std::vector<std::filesystem::path> shipped_scenes();

/// A path stays as it is; a bare name ("town") is looked up among the shipped scenes.
/// Throws Error with the known names if there is none of that name.
std::filesystem::path find_scene(const std::string& path_or_name);

}  // namespace spindrift::app
