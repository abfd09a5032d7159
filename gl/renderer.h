// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/backend.h"
#include "core/splatter.h"
#include "core/view.h"
#include "core/world.h"
#include "gl/flake_buffers.h"
#include "gl/frame_plan.h"
#include "image/image.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::gl
{

struct PassTime
{
    std::string name;
    double ms;
};

/// Draws a scene and its flakes into an RGBA16F target, then tone-maps to 8 bit. Needs a current context.
class Renderer
{
  public:
    /// `world`, `buffers` and `splatter` must outlive it; without one, plans whose flakes are drawn in tiles
    /// are refused.
    Renderer(const scene::Scene& scene, const scene::Geometry& geometry, const World& world,
             const FlakeBuffers& buffers, int width_px, int height_px, Splatter* splatter = nullptr);
    ~Renderer();

    /// `time_s` is the moment at which the frame is shown. Passes of the plan that do not run are not
    /// touched.
    void draw(const FramePlan& plan, const View& view, const DrawList& flakes, double time_s);

    /// Blocks until the GPU has read the flakes of the last draw(); call it before a backend writes them
    /// again. Returns at once if the buffers are not mapped: who writes those is ordered behind GL.
    void wait_for_flakes() const;

    void resize(int width_px, int height_px);
    image::Image read_linear() const;    ///< the float target, rows from the top
    image::Image8 read_display() const;  ///< after tone curve and sRGB
    /// Develops the last frame once more as an 8-bit target would have shown it: light clamped at white, no
    /// bloom, no curve. read_display() then gives that.
    void develop_low_range();
    void present(int framebuffer_width, int framebuffer_height);  ///< to the window's back buffer

    /// Of the last frame, when it had such a pass; both wait for the GPU.
    double exposure() const;
    bool found_bright() const;  ///< false: the bloom pass found nothing to spread, and spread nothing

    /// GPU times of the last frame that is complete, by pass (GL timer queries); empty before the first.
    std::vector<PassTime> times() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace spindrift::gl
