// SPDX-License-Identifier: MIT
#include "app/window_loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "app/frame_drawer.h"
#include "app/sort_choice.h"
#include "gl/window.h"
#include "scene/make_world.h"

namespace spindrift::app
{

namespace
{

using Clock = std::chrono::steady_clock;

/// A frame that took longer than this slows the snow down instead of asking for ever more steps.
constexpr double kLongestCatchUp_s = 0.1;

std::string next_strategy(std::string_view backend, const std::string& now)
{
    const auto table = sorts_of(backend);
    const auto found = std::ranges::find(table, now, &SortName::name);
    const auto next = found == table.end() || found + 1 == table.end() ? table.begin() : found + 1;
    return std::string(next->name);
}

/// Indices of World::anchors that stand for the camera.
std::vector<int> camera_anchors(const RunInput& input)
{
    std::vector<int> anchors;
    for (std::size_t i = 0; i < input.scene.emitters.size(); ++i)
        if (input.scene.emitters[i].follows == "camera" && input.world.emitters[i].anchor >= 0)
            anchors.push_back(input.world.emitters[i].anchor);
    return anchors;
}

/// One run in a window: what a person steers, and the time that has passed for the snow.
class WindowRun
{
  public:
    WindowRun(RunState& run, gl::Window& window, Simulator& simulator)
        : run_(run),
          window_(window),
          simulator_(simulator),
          drawer_(run.input.scene, run.input.geometry, run.input.world, simulator, window.info(),
                  cpu_options(run.options), run.log),
          anchors_(camera_anchors(run.input)),
          time_s_(make_clock(run.input, simulator.backend().step_number()).start_s)
    {
    }

    void frame()
    {
        const StageTimer whole_frame(run_.log, "frame");
        const double passed_s = since_last_frame();
        window_.poll(scene::camera_at(run_.input.scene, time_s_));
        if (!window_.paused()) time_s_ += std::min(passed_s, kLongestCatchUp_s);
        if (window_.step_once())
            time_s_ = static_cast<double>(simulator_.backend().step_number() + 1) * run_.input.world.step_s;
        if (window_.next_sort())
            drawer_.set_sort(next_strategy(run_.input.choice.name, drawer_.sort().strategy));
        const View view = window_.view(scene::camera_at(run_.input.scene, time_s_));
        carry_skies(view);
        // The margin forgives rounding, as in FrameClock.
        const double steps = std::floor(time_s_ / run_.input.world.step_s + 1e-6);
        if (!advance(run_, simulator_, static_cast<std::uint64_t>(steps))) return;
        if (view.width_px > 0 && view.height_px > 0) show(view);
        ++run_.report.frames;
    }

    void conclude_drawing()
    {
        run_.report.passes = drawer_.plans().passes();
        run_.report.flakes = {drawer_.sort(), drawer_.drawn(), drawer_.culled()};
    }

  private:
    double since_last_frame()
    {
        const auto now = Clock::now();
        const std::chrono::duration<double> passed = now - std::exchange(last_, now);
        return passed.count();
    }

    /// Once steered, the camera and not the scene file says where the skies go that follow it.
    void carry_skies(const View& view)
    {
        if (window_.camera_mode() == gl::CameraMode::scene && !steered_) return;
        steered_ = true;
        for (const int anchor : anchors_) simulator_.backend().set_anchor(anchor, view.eye);
    }

    void show(const View& view)
    {
        drawer_.draw(view, time_s_);
        drawer_.renderer().present(view.width_px, view.height_px);
        window_.draw_overlay(overlay());
        const StageTimer timer(run_.log, "show");
        window_.show();
    }

    gl::OverlayText overlay() const
    {
        gl::OverlayText text;
        text.stage_ms = run_.log.newest();
        text.facts = {
            {"time", fmt::format("{:.2f} s", time_s_)},
            {"flakes alive", fmt::format("{}", simulator_.backend().counts().alive)},
            {"flakes drawn", fmt::format("{:.0f}", drawer_.drawn().back())},
            {"sort", fmt::format("{}, {} bits", drawer_.sort().strategy, drawer_.sort().depth_bits)}};
        return text;
    }

    RunState& run_;
    gl::Window& window_;
    Simulator& simulator_;
    FrameDrawer drawer_;
    std::vector<int> anchors_;
    double time_s_;
    Clock::time_point last_ = Clock::now();
    bool steered_ = false;
};

}  // namespace

void draw_in_window(RunState& run)
{
    const scene::RenderSettings& render = run.input.scene.render;
    gl::WindowOptions options;
    options.width_px = render.width_px;
    options.height_px = render.height_px;
    options.title = "Spindrift - " + run.input.scene.name;
    gl::Window window(options);
    run.report.gl = window.info();
    const auto simulator = start_simulator(run, Drawing::on);
    warm_up(run, *simulator, make_clock(run.input, simulator->backend().step_number()).steps_before(0));
    WindowRun shown(run, window, *simulator);
    const std::optional<int> frames = run.options.overrides.frames;
    while (!window.wants_close() && !run.interrupt.requested())
    {
        if (frames && run.report.frames >= static_cast<std::uint64_t>(*frames)) break;
        shown.frame();
    }
    shown.conclude_drawing();
    run.report.gl_errors = gl::Context::debug_errors();
    conclude(run, *simulator);
}

}  // namespace spindrift::app
