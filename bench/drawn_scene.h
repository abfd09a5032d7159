// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/bare_points.h"
#include "core/backend.h"
#include "core/splatter.h"
#include "core/view.h"
#include "gl/context.h"
#include "gl/flake_buffers.h"
#include "gl/frame_plan.h"
#include "gl/renderer.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::bench
{

/// A shipped scene, or one made up, with backend and renderer, stage by stage, for measuring. Makes its own
/// headless context.
class DrawnScene
{
  public:
    /// `name` without folder and suffix.
    DrawnScene(const std::string& name, std::uint64_t particles, int width_px, int height_px);
    explicit DrawnScene(scene::Scene scene);

    void step();
    void prepare();
    /// Every pass of the frame plan, until the picture is there.
    void draw();
    /// Some passes of the frame plan alone, over what the last draw() left, until it is there. Where tiles
    /// develop the picture too, tone alone is nothing.
    void draw_passes(std::initializer_list<std::string_view> names);
    /// The picture in 8 bit, on the host.
    image::Image8 display() const { return renderer_->read_display(); }

    /// The points of the draw list, in its order, as the flake pass places and sizes them.
    std::vector<BarePoint> points() const;
    /// Steps that one frame of the scene takes.
    int steps_per_frame() const;

    Backend& backend() { return *backend_; }
    std::uint64_t drawn() const { return list_.count; }
    double time_s() const { return time_s_; }
    std::string driver() const { return context_->info().renderer; }
    image::Image picture() const { return renderer_->read_linear(); }
    image::Image reference_picture() const;

  private:
    std::unique_ptr<gl::Context> context_;
    scene::Scene scene_;
    scene::Geometry geometry_;
    World world_;
    std::unique_ptr<gl::FlakeBuffers> buffers_;
    std::unique_ptr<Backend> backend_;
    std::unique_ptr<Splatter> splatter_;
    std::unique_ptr<gl::Renderer> renderer_;
    View view_;
    DrawList list_;
    gl::FramePlan plan_;
    double time_s_ = 0;
};

}  // namespace spindrift::bench
