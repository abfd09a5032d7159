// SPDX-License-Identifier: MIT
#pragma once

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

/// Headless, through EGL: Mesa surfaceless, else a device. Throws Error with what each way answered.
std::unique_ptr<Context> make_headless_context();

}  // namespace spindrift::gl
