// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cpu/cpu_backend.h"
#include "measure/sort_keys.h"
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
    std::optional<int> threads;  ///< these two are the CPU's
    std::optional<cpu::Simd> simd;
    std::optional<bool> cuda_graph;  ///< this one is CUDA's
    Interop interop = Interop::automatic;
    std::optional<std::uint64_t> steps;      ///< simulate this many and draw nothing
    bool beside_ldr = false;                 ///< pictures twice as wide: low dynamic range on the left
    std::filesystem::path luminance;         ///< table of the pixels' luminance, frame by frame
    std::vector<std::array<int, 2>> pixels;  ///< column and row from the upper left
    std::filesystem::path stats, save_snapshot, load_snapshot;
    bool hash = false;
};

inline cpu::CpuOptions cpu_options(const RunOptions& options)
{
    cpu::CpuOptions cpu;
    cpu.threads = options.threads.value_or(cpu.threads);
    cpu.simd = options.simd.value_or(cpu.simd);
    return cpu;
}

/// What `spindrift sorts` was asked for.
struct SortsOptions
{
    std::string scene;  ///< empty: none
    scene::SceneOverrides overrides;
    std::vector<std::size_t> sizes;             ///< empty: the usual
    std::vector<measure::KeyPattern> patterns;  ///< empty: all
    std::vector<std::string> strategies;        ///< empty: all
    std::string backend = "auto";               ///< auto: all that are there
    bool table_4_1 = false;
    std::vector<std::filesystem::path> out;
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

struct WindOptions
{
    std::string scene;
    scene::SceneOverrides overrides;
    std::filesystem::path out;
    std::string backend = "auto";
    std::optional<int> threads;  ///< of the CPU backend
    bool relax = false;          ///< by red-black over-relaxation instead of multigrid
};

/// What `spindrift validate` was asked for.
struct ValidateOptions
{
    std::vector<std::string> cases;          ///< empty: all
    std::optional<std::uint64_t> particles;  ///< these two: unless given, each case has its own
    std::vector<double> dt_s;
    std::uint64_t seed = 1;
    int threads = 0;             ///< 0: one per core
    std::filesystem::path data;  ///< empty: what SPINDRIFT_TEST_DATA names, if anything
    bool json = false;
};

/// What `spindrift report` was asked for.
struct ReportOptions
{
    std::filesystem::path out;
    std::uint64_t particles = 20000;
    int most_cells = 96;  ///< along an edge of the solver's grids
};

}  // namespace spindrift::app
