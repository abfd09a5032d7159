// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace spindrift::gl
{

struct ContextInfo
{
    std::string platform;  ///< "EGL surfaceless", "EGL device", "GLFW"
    std::string renderer, vendor, version;
    bool software = false;  ///< llvmpipe, softpipe
};

/// An OpenGL 4.5 core context with GLEW loaded, current in the thread that made it. The debug callback is on
/// in debug builds and tests; what it reports as an error is kept for debug_errors().
class Context
{
  public:
    virtual ~Context() = default;
    virtual const ContextInfo& info() const = 0;
    /// Errors that the driver reported since the start, one a line; empty when all is well.
    static std::string debug_errors();
};

/// Whether a device of EGL (an EGLDeviceEXT) is wanted.
using EglDeviceRule = std::function<bool(void* egl_device)>;

/// Headless, through EGL: a wanted device, else Mesa surfaceless, else any device. Throws Error with what
/// each way answered.
std::unique_ptr<Context> make_headless_context(const EglDeviceRule& wanted = {});

}  // namespace spindrift::gl
