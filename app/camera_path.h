// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/frame_clock.h"
#include "app/simulator.h"
#include "app/sort_study.h"
#include "core/kept_order.h"
#include "gl/context.h"
#include "gl/frame_plan.h"
#include "gl/renderer.h"
#include "image/image.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::app
{

/// The frames of a scene, for sorts: what its own flakes before its own camera give to be sorted, and the
/// picture that an order makes, where there is GL.
class CameraPath
{
  public:
    /// Throws Error for a scene that is wrong.
    explicit CameraPath(scene::Scene scene);
    ~CameraPath();

    /// Simulates up to a frame, 0 being the one after the warm-up. Frames ascend.
    void go_to(std::uint64_t frame);

    /// What the frame has to be sorted, and from what a sort over frames may begin.
    KeysOfFrame keys();
    SortStart start() { return kept_order_.next(view_); }

    bool draws() const { return renderer_.has_value(); }
    std::string pictures_by() const;  ///< the GL renderer, or why there are no pictures
    double picture_error(std::span<const std::uint64_t> order, std::span<const std::uint64_t> exact);

    std::size_t capacity() const { return world_.capacity; }
    const scene::Scene& scene() const { return scene_; }

  private:
    image::Image picture(std::span<const std::uint64_t> order);
    std::vector<std::uint32_t> moves() const;

    scene::Scene scene_;
    scene::Geometry geometry_;
    World world_;
    FrameClock clock_;
    StageLog log_{StageLog::Keep::newest};
    std::string no_gl_because_;
    std::unique_ptr<gl::Context> context_;  ///< outlives all that holds GL objects
    FlakeView flakes_{};
    DrawListView draw_list_{};
    std::unique_ptr<Simulator> simulator_;
    std::optional<gl::Renderer> renderer_;

    double time_s_ = 0;
    View view_;
    KeptOrder kept_order_;
    std::vector<std::uint32_t> ids_;             ///< by slot, at the last frame that was sorted
    std::optional<image::Image> exact_picture_;  ///< of the frame at hand
};

}  // namespace spindrift::app
