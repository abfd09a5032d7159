// SPDX-License-Identifier: MIT
#include "app/engine.h"
#include "core/error.h"

namespace spindrift::app
{

CudaSupport cuda_support()
{
    return {};
}

Engine make_cuda_engine(const World&, const RunOptions&, std::uint32_t, Drawing)
{
    throw Error("this build has no CUDA backend; use --backend cpu or --backend auto");
}

PoissonSolverMaker cuda_poisson_solver()
{
    throw Error("this build has no CUDA backend; use --backend cpu or --backend auto");
}

std::unique_ptr<gl::Context> make_drawing_context()
{
    return gl::make_headless_context();
}

WayToGl cuda_way_to_gl()
{
    throw Error("this build has no CUDA backend");
}

}  // namespace spindrift::app
