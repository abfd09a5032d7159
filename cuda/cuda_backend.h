// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "core/backend.h"
#include "core/world.h"
#include "cuda/flake_memory.h"

namespace spindrift::gpu
{

/// Whether the kernels of a step are queued one by one or as one graph, captured once.
enum class StepGraph
{
    off,
    on,
};

struct CudaOptions
{
    StepGraph graph = StepGraph::on;
    /// Puts the flakes in the order of the wind cells that they read after every so many steps; 0: never.
    /// Without a wind grid there is nothing to order by. The results are the same.
    std::uint32_t reorder_every_steps = 0;
};

/// The CUDA implementation of Backend, on the current device. `memory` has world.capacity elements and must
/// outlive it. Nothing is allocated and nobody waits in a step; counts() come late. Throws Error if the
/// device has no room.
std::unique_ptr<Backend> make_cuda_backend(const World& world, FlakeMemory& memory,
                                           const CudaOptions& options);

}  // namespace spindrift::gpu
