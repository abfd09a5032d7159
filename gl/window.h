// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/view.h"
#include "gl/camera_rig.h"
#include "gl/context.h"

namespace spindrift::gl
{

struct WindowOptions
{
    int width_px = 1280, height_px = 720;
    std::string title = "Spindrift";
    bool wait_for_screen = true;  ///< show() waits for the screen's refresh
};

/// What the overlay shows; the caller formats nothing but names.
struct OverlayText
{
    std::vector<std::pair<std::string, double>> stage_ms;
    std::vector<std::pair<std::string, std::string>> facts;  ///< "flakes" -> "1 000 000"
};

/// A window with an OpenGL 4.5 core context, current in the thread that made it, its camera, its keys and a
/// small overlay. Keys: W A S D move, Q E down and up, Shift fast, right drag looks, left drag orbits, wheel:
/// speed or distance, C the scene's camera, Space pause, N single step, T next sort strategy, F1 overlay, Esc
/// quit.
///
/// A frame: poll(); simulate; view(); draw; Renderer::present(width, height); draw_overlay(); show().
class Window : public Context
{
  public:
    /// Throws Error that names what GLFW says and --headless.
    explicit Window(const WindowOptions& options);
    ~Window() override;
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    const ContextInfo& info() const override;

    /// Reads events and moves the camera, which starts from the scene's view of this moment, by the time
    /// since the last call.
    void poll(const View& scene_view);
    /// The scene's view, or the steered one once somebody took hold of it; its size is the window's.
    View view(const View& scene_view) const;
    CameraMode camera_mode() const;

    bool wants_close() const;
    bool paused() const;
    bool step_once();  ///< true once per press of the key (which also pauses)
    bool next_sort();  ///< true once per press of the key

    int width_px() const;  ///< of the framebuffer; 0 while minimised
    int height_px() const;

    void draw_overlay(const OverlayText& text);
    void show();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace spindrift::gl
