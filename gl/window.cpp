// SPDX-License-Identifier: MIT
#include "gl/window.h"

#include <GL/glew.h>
// GLEW first: it stands in for the system's GL header.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "gl/load_gl.h"

namespace spindrift::gl
{

namespace
{

std::string glfw_answer()
{
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "no reason given";
}

/// GLFW, for as long as one window lives.
struct Library
{
    Library()
    {
        if (glfwInit() == GLFW_FALSE)
            throw Error(fmt::format("no window can be opened here ({}); use --headless", glfw_answer()));
    }
    ~Library() { glfwTerminate(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

struct WindowDeleter
{
    void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};

/// Dear ImGui and its two backends.
struct Overlay
{
    explicit Overlay(GLFWwindow* window)
    {
        IMGUI_CHECKVERSION();
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
        ImGui_ImplGlfw_InitForOpenGL(window, true);
        ImGui_ImplOpenGL3_Init("#version 450 core");
    }
    ~Overlay()
    {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;
};

float axis(GLFWwindow* window, int plus, int minus)
{
    return static_cast<float>(glfwGetKey(window, plus) == GLFW_PRESS) -
           static_cast<float>(glfwGetKey(window, minus) == GLFW_PRESS);
}

}  // namespace

struct Window::Impl
{
    Library library;
    std::unique_ptr<GLFWwindow, WindowDeleter> window;
    ContextInfo info;
    std::unique_ptr<Overlay> overlay;
    CameraRig rig;
    bool paused = false, step = false, sort = false, overlay_on = true, back_to_scene = false;
    float wheel = 0;
    double last_time_s = 0, mouse_x = 0, mouse_y = 0;
    double frame_s = 0;

    explicit Impl(const WindowOptions& options)
    {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        window.reset(
            glfwCreateWindow(options.width_px, options.height_px, options.title.c_str(), nullptr, nullptr));
        if (!window)
            throw Error(fmt::format("no window with OpenGL 4.5 can be opened here ({}); use --headless",
                                    glfw_answer()));
        glfwMakeContextCurrent(window.get());
        info = load_gl("GLFW");
        glfwSwapInterval(options.wait_for_screen ? 1 : 0);
        glfwSetWindowUserPointer(window.get(), this);
        // Before ImGui's own, which call on what they find.
        glfwSetKeyCallback(window.get(), on_key);
        glfwSetScrollCallback(window.get(), on_scroll);
        overlay = std::make_unique<Overlay>(window.get());
        last_time_s = glfwGetTime();
        glfwGetCursorPos(window.get(), &mouse_x, &mouse_y);
    }

    static Impl& of(GLFWwindow* window) { return *static_cast<Impl*>(glfwGetWindowUserPointer(window)); }

    static void on_scroll(GLFWwindow* window, double, double notches)
    {
        of(window).wheel += static_cast<float>(notches);
    }

    static void on_key(GLFWwindow* window, int key, int, int action, int)
    {
        if (action == GLFW_PRESS) of(window).press(key);
    }

    void press(int key)
    {
        switch (key)
        {
            case GLFW_KEY_ESCAPE:
                glfwSetWindowShouldClose(window.get(), GLFW_TRUE);
                break;
            case GLFW_KEY_SPACE:
                paused = !paused;
                break;
            case GLFW_KEY_N:
                paused = true;
                step = true;
                break;
            case GLFW_KEY_T:
                sort = true;
                break;
            case GLFW_KEY_C:
                back_to_scene = true;
                break;
            case GLFW_KEY_F1:
                overlay_on = !overlay_on;
                break;
            default:
                break;
        }
    }

    CameraInput read_camera()
    {
        GLFWwindow* w = window.get();
        CameraInput input;
        input.right = axis(w, GLFW_KEY_D, GLFW_KEY_A);
        input.forward = axis(w, GLFW_KEY_W, GLFW_KEY_S);
        input.up = axis(w, GLFW_KEY_E, GLFW_KEY_Q);
        input.fast = glfwGetKey(w, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS;
        const double x = std::exchange(mouse_x, 0);
        const double y = std::exchange(mouse_y, 0);
        glfwGetCursorPos(w, &mouse_x, &mouse_y);
        const auto dx = static_cast<float>(mouse_x - x);
        const auto dy = static_cast<float>(mouse_y - y);
        if (glfwGetMouseButton(w, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS)
        {
            input.look_x_px = dx;
            input.look_y_px = dy;
        }
        else if (glfwGetMouseButton(w, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS)
        {
            input.orbit_x_px = dx;
            input.orbit_y_px = dy;
        }
        input.zoom = std::exchange(wheel, 0.0F);
        input.back_to_scene = std::exchange(back_to_scene, false);
        return input;
    }

    std::pair<int, int> size() const
    {
        int width = 0;
        int height = 0;
        glfwGetFramebufferSize(window.get(), &width, &height);
        return {width, height};
    }

    void list(const OverlayText& text) const
    {
        ImGui::Text("%.1f ms  %.0f fps%s", 1e3 * frame_s, frame_s > 0 ? 1 / frame_s : 0,
                    paused ? "  paused" : "");
        for (const auto& [name, value] : text.facts) ImGui::Text("%-14s %s", name.c_str(), value.c_str());
        ImGui::Separator();
        for (const auto& [name, ms] : text.stage_ms) ImGui::Text("%-14s %8.2f ms", name.c_str(), ms);
    }
};

Window::Window(const WindowOptions& options) : impl_(std::make_unique<Impl>(options)) {}
Window::~Window() = default;

const ContextInfo& Window::info() const
{
    return impl_->info;
}

void Window::poll(const View& scene_view)
{
    glfwPollEvents();
    const double now_s = glfwGetTime();
    // A long stall must not throw the camera far away.
    const double dt_s = std::min(now_s - impl_->last_time_s, 0.25);
    impl_->last_time_s = now_s;
    // Smoothed over about ten frames, to be readable.
    impl_->frame_s += 0.1 * (dt_s - impl_->frame_s);
    impl_->rig.advance(impl_->read_camera(), scene_view, dt_s);
}

View Window::view(const View& scene_view) const
{
    View view = impl_->rig.view(scene_view);
    view.width_px = std::max(width_px(), 1);
    view.height_px = std::max(height_px(), 1);
    return view;
}

CameraMode Window::camera_mode() const
{
    return impl_->rig.mode();
}
bool Window::wants_close() const
{
    return glfwWindowShouldClose(impl_->window.get()) != GLFW_FALSE;
}
bool Window::paused() const
{
    return impl_->paused;
}
bool Window::step_once()
{
    return std::exchange(impl_->step, false);
}
bool Window::next_sort()
{
    return std::exchange(impl_->sort, false);
}
int Window::width_px() const
{
    return impl_->size().first;
}
int Window::height_px() const
{
    return impl_->size().second;
}

void Window::draw_overlay(const OverlayText& text)
{
    if (!impl_->overlay_on) return;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({8, 8});
    ImGui::SetNextWindowBgAlpha(0.6F);
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                       ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings;
    if (ImGui::Begin("stages", nullptr, flags)) impl_->list(text);
    ImGui::End();
    ImGui::Render();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width_px(), height_px());
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::show()
{
    glfwSwapBuffers(impl_->window.get());
}

}  // namespace spindrift::gl
