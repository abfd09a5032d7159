// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cpu/cpu_backend.h"
#include "scene/scene.h"

namespace spindrift::app
{

/// Whether the simulation writes the memory that GL draws from, or its own that is copied over before each
/// frame.
enum class Interop
{
    automatic,  ///< write GL's memory
    on,
    off,  ///< staged copy
};

/// What `spindrift run` was asked for. Paths that are empty were not given.
struct RunOptions
{
    std::string scene;
    bool headless = false;
    scene::SceneOverrides overrides;
    std::optional<int> depth_bits;
    std::vector<std::string> out;
    std::string backend = "auto";
    cpu::CpuOptions cpu;
    Interop interop = Interop::automatic;
    std::optional<std::uint64_t> steps;      ///< simulate this many and draw nothing
    bool beside_ldr = false;                 ///< pictures twice as wide: low dynamic range on the left
    std::filesystem::path luminance;         ///< table of the pixels' luminance, frame by frame
    std::vector<std::array<int, 2>> pixels;  ///< column and row from the upper left
    std::filesystem::path stats, save_snapshot, load_snapshot;
    bool hash = false;
};

struct ExplainOptions
{
    std::string scene;
    scene::SceneOverrides overrides;
    bool json = false;
};

}  // namespace spindrift::app
