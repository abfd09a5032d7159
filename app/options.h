// SPDX-License-Identifier: MIT
#pragma once

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
    std::optional<std::uint64_t> steps;  ///< simulate this many and draw nothing
    std::filesystem::path stats, save_snapshot, load_snapshot;
    bool hash = false;
};

/// What `spindrift calibrate` was asked for. Paths that are empty were not given.
struct CalibrateOptions
{
    std::string scene = "sheet";
    scene::SceneOverrides overrides;
    int frames = 5;           ///< averaged at each rate
    double most_per_s = 1e6;  ///< rates of the report's table up to here
    std::filesystem::path csv, plot;
};

struct ExplainOptions
{
    std::string scene;
    scene::SceneOverrides overrides;
    bool json = false;
};

}  // namespace spindrift::app
