// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/flake_memory.h"
#include "app/options.h"
#include "core/backend.h"
#include "core/poisson_solver.h"
#include "core/world.h"
#include "gl/context.h"

namespace spindrift::app
{

/// How the flakes come to GL.
struct WayToGl
{
    std::string memory;   ///< where they live and how they get there, in words
    bool shared = false;  ///< GL draws from the memory that the simulation writes
    std::string because;  ///< why shared or not
};

/// What moves the flakes of a run, and where they live. The backend works on the memory, which outlives it.
struct Engine
{
    std::unique_ptr<FlakeMemory> memory;
    std::unique_ptr<Backend> backend;
    WayToGl way;
};

/// Whether pictures are made; then a GL context must be current.
enum class Drawing
{
    off,
    on,
};

// Throw Error if the machine cannot do what was asked.

Engine make_cpu_engine(const World& world, const RunOptions& options, std::uint32_t reorder_every_steps,
                       Drawing drawing);
Engine make_cuda_engine(const World& world, const RunOptions& options, std::uint32_t reorder_every_steps,
                        Drawing drawing);

/// Solves for winds on the current CUDA device. Throws Error in a build without CUDA.
PoissonSolverMaker cuda_poisson_solver();

/// What this build and machine have of CUDA.
struct CudaSupport
{
    bool built = false;
    std::vector<std::string> devices;  ///< in words, by ordinal
    std::string none_because;          ///< in the runtime's words, if there is no device
    std::string versions;              ///< of runtime and driver
};
CudaSupport cuda_support();

/// A headless context; on a GPU that CUDA has, where the build has CUDA and EGL offers one. Throws Error.
std::unique_ptr<gl::Context> make_drawing_context();
/// The way from CUDA to the current GL context that `--interop auto` takes. Throws Error without a device.
WayToGl cuda_way_to_gl();

}  // namespace spindrift::app
