// SPDX-License-Identifier: MIT
#include "gl/window.h"

#include <GL/glew.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "gl/flake_buffers.h"
#include "gl/renderer.h"

// GLFW unloads the driver, whose caches LeakSanitizer then reports without a name by which they could be
// suppressed.
extern "C" int __lsan_is_turned_off();
extern "C" int __lsan_is_turned_off()
{
    return 1;
}

namespace spindrift::gl
{
namespace
{

/// An Xvfb of its own, on a display number that it picks itself; DISPLAY names it while this lives.
class VirtualDisplay
{
  public:
    VirtualDisplay()
    {
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0) return;
        server_ = fork();
        if (server_ == 0)
        {
            close(ends[0]);
            const std::string fd = std::to_string(ends[1]);
            const int nowhere = open("/dev/null", O_WRONLY);
            dup2(nowhere, STDERR_FILENO);
            execlp("Xvfb", "Xvfb", "-displayfd", fd.c_str(), "-screen", "0", "800x600x24", "-nolisten", "tcp",
                   nullptr);
            _exit(127);
        }
        close(ends[1]);
        std::string number;
        char c = 0;
        while (read(ends[0], &c, 1) == 1 && c != '\n') number += c;
        close(ends[0]);
        running_ = !number.empty();
        if (running_) setenv("DISPLAY", (":" + number).c_str(), 1);
    }
    ~VirtualDisplay()
    {
        if (server_ <= 0) return;
        kill(server_, SIGTERM);
        waitpid(server_, nullptr, 0);
        unsetenv("DISPLAY");
    }
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;
    bool running() const { return running_; }

  private:
    pid_t server_ = -1;
    bool running_ = false;
};

std::vector<unsigned char> back_buffer(const Window& window)
{
    std::vector<unsigned char> pixels(static_cast<std::size_t>(window.width_px()) *
                                      static_cast<std::size_t>(window.height_px()) * 4);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glReadPixels(0, 0, window.width_px(), window.height_px(), GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    return pixels;
}

TEST(Context, OutlivesAnotherOfItsKind)
{
    std::unique_ptr<Context> first = make_headless_context();
    const std::unique_ptr<Context> second = make_headless_context();
    first.reset();
    // Destroying one must not take the display from the other, which stays current.
    EXPECT_NE(glGetString(GL_VERSION), nullptr);
}

TEST(Window, OpensDrawsAndShows)
{
    const VirtualDisplay display;
    if (!display.running()) GTEST_SKIP() << "Xvfb is not installed";
    Window window({320, 200, "test", false});
    EXPECT_EQ(window.info().platform, "GLFW");
    EXPECT_EQ(window.width_px(), 320);
    EXPECT_EQ(window.height_px(), 200);

    scene::Scene scene;
    scene.ground.kind = scene::GroundKind::none;
    scene.sky.horizon = scene.sky.zenith = {0.2F, 0.4F, 0.8F};
    const FlakeBuffers buffers(1);
    const View scene_view;
    Renderer renderer(scene, {}, {}, buffers, 320, 200);
    std::vector<unsigned char> plain;
    std::vector<unsigned char> with_overlay;
    for (int frame = 0; frame < 3; ++frame)
    {
        window.poll(scene_view);
        const View view = window.view(scene_view);
        EXPECT_EQ(view.width_px, 320);
        renderer.draw(plan_frame(scene, view, {}, 0), view, {}, 0);
        renderer.present(window.width_px(), window.height_px());
        plain = back_buffer(window);
        window.draw_overlay({{{"advect", 1.25}, {"sort", 0.5}}, {{"flakes", "1 000"}}});
        with_overlay = back_buffer(window);
        window.show();
    }
    const std::size_t middle = (100 * 320 + 250) * 4;
    EXPECT_NEAR(plain[middle + 2], 231, 1) << "sRGB of 0.8";
    EXPECT_NE(plain, with_overlay);
    EXPECT_EQ(with_overlay[middle + 2], plain[middle + 2]) << "the overlay is small";
    EXPECT_FALSE(window.wants_close());
    EXPECT_FALSE(window.paused());
    EXPECT_FALSE(window.step_once());
    EXPECT_FALSE(window.next_sort());
    EXPECT_EQ(window.camera_mode(), CameraMode::scene);
    EXPECT_EQ(Context::debug_errors(), "");
}

TEST(Window, WithoutDisplayNamesHeadless)
{
    if (std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr)
        GTEST_SKIP() << "there is a display";
    try
    {
        const Window window({});
        FAIL() << "no display to open a window on";
    }
    catch (const Error& error)
    {
        EXPECT_NE(std::string(error.what()).find("--headless"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace spindrift::gl
