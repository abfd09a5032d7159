// SPDX-License-Identifier: MIT
#include "gl/load_gl.h"

#include <GL/glew.h>

#include <fmt/format.h>

#include "core/error.h"
#include "gl/debug_log.h"

namespace spindrift::gl
{

namespace
{

std::string text_of(GLenum what)
{
    const GLubyte* text = glGetString(what);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

}  // namespace

ContextInfo load_gl(const std::string& platform)
{
    glewExperimental = GL_TRUE;
    const GLenum status = glewInit();
    // GLEW looks for GLX last; without an X display it says so although every GL function is loaded.
    if (status != GLEW_OK && status != GLEW_ERROR_NO_GLX_DISPLAY)
        throw Error(fmt::format("GLEW cannot load OpenGL on {}: {}", platform,
                                reinterpret_cast<const char*>(glewGetErrorString(status))));
    while (glGetError() != GL_NO_ERROR)
    {
        // What GLEW's own probing left behind.
    }
    ContextInfo info;
    info.platform = platform;
    info.renderer = text_of(GL_RENDERER);
    info.vendor = text_of(GL_VENDOR);
    info.version = text_of(GL_VERSION);
    for (const char* name : {"llvmpipe", "softpipe", "SWR"})
        if (info.renderer.find(name) != std::string::npos) info.software = true;
    if (!GLEW_VERSION_4_5)
        throw Error(
            fmt::format("{} offers OpenGL {} on {}; 4.5 is needed", platform, info.version, info.renderer));
    start_debug_log();
    return info;
}

}  // namespace spindrift::gl
