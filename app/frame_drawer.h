// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/plan_log.h"
#include "app/simulator.h"
#include "app/stage_log.h"
#include "core/splatter.h"
#include "cpu/cpu_backend.h"
#include "gl/context.h"
#include "gl/frame_plan.h"
#include "gl/renderer.h"

namespace spindrift::app
{

/// Plans and draws frame after frame of a run: culls and sorts only when the flakes, the camera or the
/// settings changed.
class FrameDrawer
{
  public:
    /// All arguments must outlive it. The simulator's memory must be one that GL draws from. `cpu`: with what
    /// tiles are blended. Throws Error if the scene asks for tiles and the processor cannot read the flakes.
    FrameDrawer(const scene::Scene& scene, const scene::Geometry& geometry, const World& world,
                Simulator& simulator, const gl::ContextInfo& gl, const cpu::CpuOptions& cpu, StageLog& log);

    void draw(const View& view, double time_s);

    gl::Renderer& renderer() { return renderer_; }
    /// Of all frames so far, by what the GPU found in them too; waits for the last one.
    const PlanLog& plans();
    SortSettings sort() const
    {
        return {scene_.render.sort, scene_.render.depth_bits, scene_.render.sort_passes_per_frame};
    }
    void set_sort(const std::string& strategy);

    /// Flakes drawn and culled, one sample a frame.
    const std::vector<float>& drawn() const { return drawn_; }
    const std::vector<float>& culled() const { return culled_; }

  private:
    /// Asks the GPU about the last frame's bloom, once it is done.
    void settle_bloom();
    gl::FramePlan plan(const View& view, double time_s, const FlakeCounts& counts) const;
    /// Makes the draw list anew if anything moved. Returns the counts of the steps that were made.
    FlakeCounts list_flakes(const View& view, double time_s);

    scene::Scene scene_;  ///< its sort may be changed
    const scene::Geometry& geometry_;
    Simulator& simulator_;
    StageLog& log_;
    double brightest_emission_;
    gl::GlKind gl_;
    std::unique_ptr<Splatter> splatter_;
    gl::Renderer renderer_;
    PlanLog plans_;
    bool bloomed_ = false;  ///< the plan of the last frame, not settled yet
    bool stale_ = true;     ///< the draw list must be made anew whatever moved
    std::optional<View> last_view_;
    std::optional<double> last_time_s_;
    std::uint64_t last_step_ = 0;
    DrawList list_;
    FlakeCounts counts_;               ///< when the list was made
    std::optional<gl::Moving> shown_;  ///< in the last frame
    gl::ShadowCast shadows_;           ///< for which maps are kept
    bool snow_shaded_ = false;
    std::vector<float> drawn_, culled_;
};

}  // namespace spindrift::app
