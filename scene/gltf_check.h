// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

namespace spindrift::scene
{

/// For .gltf and .glb files, before a reader that trusts them sees them: whole JSON, chunks as long as they
/// say, every index of nodes, meshes, accessors and views within its array, no node below itself, accessors
/// within their views, views within their buffers. Returns the emissive strength of each material
/// (KHR_materials_emissive_strength). Other files: an empty list. Throws Error with the file and the first
/// thing wrong.
std::vector<float> check_gltf(const std::filesystem::path& file);

}  // namespace spindrift::scene
