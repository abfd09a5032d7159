// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "core/poisson_solver.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

/// On the current device. Its sums are those of the processor, so that both give the same bits. Throws Error
/// if the device has no room: some 110 bytes a cell.
std::unique_ptr<PoissonSolver> make_poisson_solver(const PoissonProblem& problem);
/// The same on a stream that somebody else owns and that outlives it.
std::unique_ptr<PoissonSolver> make_poisson_solver(const PoissonProblem& problem, StreamRef stream);

}  // namespace spindrift::gpu
