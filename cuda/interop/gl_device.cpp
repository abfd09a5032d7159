// SPDX-License-Identifier: MIT
#include "cuda/interop/gl_device.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <span>

#include "cuda/check.h"

namespace spindrift::gpu
{

namespace
{

/// The CUDA ordinal that an EGL device reports (EGL_NV_device_cuda).
std::optional<int> ordinal_of(EGLDeviceEXT device)
{
    const auto query =
        reinterpret_cast<PFNEGLQUERYDEVICEATTRIBEXTPROC>(eglGetProcAddress("eglQueryDeviceAttribEXT"));
    EGLAttrib ordinal = -1;
    if (query == nullptr || query(device, EGL_CUDA_DEVICE_NV, &ordinal) == EGL_FALSE)
    {
        eglGetError();  // other drivers answer EGL_BAD_ATTRIBUTE
        return {};
    }
    return static_cast<int>(ordinal);
}

/// The same for the current context; none under GLX, or where the device does not say.
std::optional<int> ordinal_of_context()
{
    EGLDisplay display = eglGetCurrentDisplay();
    const auto query =
        reinterpret_cast<PFNEGLQUERYDISPLAYATTRIBEXTPROC>(eglGetProcAddress("eglQueryDisplayAttribEXT"));
    EGLAttrib device = 0;
    if (display == EGL_NO_DISPLAY || query == nullptr) return {};
    if (query(display, EGL_DEVICE_EXT, &device) == EGL_FALSE || device == 0)
    {
        eglGetError();
        return {};
    }
    return ordinal_of(reinterpret_cast<EGLDeviceEXT>(device));
}

bool is_visible_to_cuda(void* egl_device)
{
    int count = 0;
    if (cudaGetDeviceCount(&count) != cudaSuccess) count = 0;
    cudaGetLastError();
    const std::optional<int> ordinal = ordinal_of(egl_device);
    return ordinal && *ordinal >= 0 && *ordinal < count;
}

}  // namespace

GlDevice device_of_context(const GraphicsCalls& calls)
{
    std::array<int, 16> room{};
    unsigned count = 0;
    const cudaError_t code =
        calls.devices(&count, room.data(), static_cast<unsigned>(room.size()), cudaGLDeviceListAll);
    cudaGetLastError();
    if (code != cudaSuccess) return {{}, fmt::format("cudaGLGetDevices failed: {}", error_text(code))};
    const std::span<const int> found(room.data(), std::min<std::size_t>(count, room.size()));
    if (found.empty()) return {{}, "CUDA finds none of its devices behind this OpenGL context"};

    const std::optional<int> egl = ordinal_of_context();
    if (!egl) return {found.front(), "named by cudaGLGetDevices"};
    if (std::find(found.begin(), found.end(), *egl) == found.end())
        return {{},
                fmt::format("EGL draws on CUDA device {}, but cudaGLGetDevices names {}", *egl,
                            fmt::join(found, ", "))};
    return {*egl, "named by EGL and cudaGLGetDevices"};
}

std::unique_ptr<gl::Context> make_context_beside_cuda()
{
    return gl::make_headless_context(is_visible_to_cuda);
}

}  // namespace spindrift::gpu
