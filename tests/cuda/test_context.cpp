// SPDX-License-Identifier: MIT
#include "cuda/interop/gl_device.h"
#include "tests/gl/stage.h"

namespace spindrift::gl
{

// On the GPU that CUDA has, if EGL offers it.
Context& test_context()
{
    static const std::unique_ptr<Context> context = gpu::make_context_beside_cuda();
    return *context;
}

}  // namespace spindrift::gl
