// SPDX-License-Identifier: MIT
#include "gl/context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <vector>

#include "core/error.h"
#include "gl/debug_log.h"
#include "gl/load_gl.h"

namespace spindrift::gl
{

namespace
{

std::string egl_error(const char* call)
{
    return fmt::format("{} failed (EGL error 0x{:04x})", call, eglGetError());
}

bool has_extension(EGLDisplay display, const char* name)
{
    const char* list = eglQueryString(display, EGL_EXTENSIONS);
    return list != nullptr && std::strstr(list, name) != nullptr;
}

/// A current context without any surface.
class HeadlessContext final : public Context
{
  public:
    HeadlessContext(EGLDisplay display, const std::string& platform) : display_(display)
    {
        try
        {
            create();
            info_ = load_gl(platform);
        }
        catch (...)
        {
            release();
            throw;
        }
    }
    ~HeadlessContext() override { release(); }
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    const ContextInfo& info() const override { return info_; }

  private:
    void create()
    {
        EGLint major = 0;
        EGLint minor = 0;
        if (eglInitialize(display_, &major, &minor) == EGL_FALSE) throw Error(egl_error("eglInitialize"));
        if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) throw Error(egl_error("eglBindAPI"));
        // Without EGL_PBUFFER_BIT the default asks for window configs, of which a headless platform has none.
        constexpr std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                               EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (eglChooseConfig(display_, wanted.data(), &config, 1, &count) == EGL_FALSE)
            throw Error(egl_error("eglChooseConfig"));
        if (count < 1) throw Error("eglChooseConfig found no config for desktop OpenGL");
        constexpr std::array<EGLint, 7> version{EGL_CONTEXT_MAJOR_VERSION,
                                                4,
                                                EGL_CONTEXT_MINOR_VERSION,
                                                5,
                                                EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                EGL_NONE};
        context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version.data());
        if (context_ == EGL_NO_CONTEXT) throw Error(egl_error("eglCreateContext (OpenGL 4.5 core)"));
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
            throw Error(egl_error("eglMakeCurrent without a surface"));
    }

    // The display itself is the process's: other contexts may live on it, so it is never terminated.
    void release()
    {
        if (context_ == EGL_NO_CONTEXT) return;
        if (eglGetCurrentContext() == context_)
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
        context_ = EGL_NO_CONTEXT;
    }

    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
    ContextInfo info_;
};

std::unique_ptr<Context> try_surfaceless(std::string& answers)
{
    try
    {
        if (!has_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
            throw Error("not offered by this EGL");
        EGLDisplay display =
            eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display == EGL_NO_DISPLAY) throw Error(egl_error("eglGetPlatformDisplay"));
        return std::make_unique<HeadlessContext>(display, "EGL surfaceless");
    }
    catch (const Error& error)
    {
        answers += fmt::format("EGL surfaceless: {}; ", error.what());
        return nullptr;
    }
}

std::vector<EGLDeviceEXT> egl_devices()
{
    if (!has_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) return {};
    const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (query == nullptr || query(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_FALSE)
        return {};
    return {devices.begin(), devices.begin() + count};
}

std::unique_ptr<Context> try_devices(const EglDeviceRule& wanted, std::string& answers)
{
    const std::vector<EGLDeviceEXT> devices = egl_devices();
    if (devices.empty()) answers += "EGL device: none offered; ";
    for (std::size_t i = 0; i < devices.size(); ++i)
    {
        if (!wanted(devices[i])) continue;
        try
        {
            EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
            if (display == EGL_NO_DISPLAY) throw Error(egl_error("eglGetPlatformDisplay"));
            return std::make_unique<HeadlessContext>(display, fmt::format("EGL device {}", i));
        }
        catch (const Error& error)
        {
            answers += fmt::format("EGL device {}: {}; ", i, error.what());
        }
    }
    return nullptr;
}

}  // namespace

std::string Context::debug_errors()
{
    return debug_log();
}

std::unique_ptr<Context> make_headless_context(const EglDeviceRule& wanted)
{
    std::string answers;
    if (wanted)
        if (auto context = try_devices(wanted, answers)) return context;
    if (auto context = try_surfaceless(answers)) return context;
    if (auto context = try_devices([](void*) { return true; }, answers)) return context;
    throw Error("no headless OpenGL 4.5 (" + answers +
                "Mesa's software driver serves: install libegl1 and libgl1-mesa-dri)");
}

}  // namespace spindrift::gl
