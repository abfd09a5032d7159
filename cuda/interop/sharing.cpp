// SPDX-License-Identifier: MIT
#include "cuda/interop/sharing.h"

#include <fmt/format.h>

#include "core/error.h"
#include "cuda/check.h"
#include "cuda/interop/gl_device.h"
#include "cuda/interop/interop_flakes.h"
#include "cuda/interop/pinned_flakes.h"
#include "cuda/interop/probe.h"

namespace spindrift::gpu
{

namespace
{

/// Who draws belongs to every reason: most often it is not the GPU that CUDA uses.
std::string with_renderer(const std::string& why)
{
    const GLubyte* renderer = glGetString(GL_RENDERER);
    if (renderer == nullptr) return why + "; no OpenGL context is current in this thread";
    return fmt::format("{}; OpenGL draws with {}", why, reinterpret_cast<const char*>(renderer));
}

Sharing refused(SharingWish wish, std::optional<int> device, const std::string& why)
{
    if (wish == SharingWish::on)
        throw Error(
            fmt::format("--interop on: OpenGL and CUDA cannot share memory here ({}); use --interop auto "
                        "or off, or see docs/troubleshooting.md",
                        why));
    return {false, device, why};
}

}  // namespace

Sharing find_sharing(SharingWish wish, const GraphicsCalls& calls)
{
    const GlDevice gl = device_of_context(calls);
    if (gl.ordinal)
        if (const cudaError_t code = cudaSetDevice(*gl.ordinal); code != cudaSuccess)
        {
            cudaGetLastError();
            return refused(
                wish, {},
                with_renderer(fmt::format("cudaSetDevice({}) failed: {}", *gl.ordinal, error_text(code))));
        }
    if (wish == SharingWish::off) return {false, gl.ordinal, "asked for with --interop off"};
    if (!gl.ordinal) return refused(wish, {}, with_renderer(gl.because));
    const std::string failure = probe_interop(calls);
    if (!failure.empty()) return refused(wish, gl.ordinal, with_renderer(failure));
    return {true, gl.ordinal,
            with_renderer(fmt::format("CUDA device {}, {}; probed", *gl.ordinal, gl.because))};
}

std::unique_ptr<DrawnMemory> make_drawn_memory(std::size_t capacity, SharingWish wish, Sharing& sharing,
                                               const GraphicsCalls& calls)
{
    if (!sharing.shared) return std::make_unique<PinnedFlakes>(capacity);
    try
    {
        return std::make_unique<InteropFlakes>(capacity, calls);
    }
    catch (const Error& error)
    {
        sharing = refused(wish, sharing.device, with_renderer(error.what()));
    }
    return std::make_unique<PinnedFlakes>(capacity);
}

std::string describe(const Sharing& sharing)
{
    return sharing.shared
               ? "GL's buffers, which CUDA writes in place"
               : "device memory, from which what is drawn is copied through page-locked memory to GL";
}

}  // namespace spindrift::gpu
