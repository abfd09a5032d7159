// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "core/backend.h"
#include "core/view.h"
#include "gl/flake_buffers.h"
#include "gl/flake_split.h"
#include "gl/lit_program.h"
#include "gl/object.h"
#include "gl/unsorted_target.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// What of a frame the flakes' drawing depends on beside the frame constants.
struct FlakeDraw
{
    const View& view;
    const DrawList& list;
    GLuint scene_depth;  ///< copy of the scene's depth; 0: nothing to fade into
    LitBy lights;
    AirKind air;
    UnsortedTarget::Samples samples{0, 1, 1};  ///< stochastic: those of this pass
    GLuint velocities = 0;                     ///< by place in the draw list, with a shutter time
};

/// Draws flakes as points that the vertex shader pulls from the simulation's own buffers.
class FlakePass
{
  public:
    FlakePass(const scene::RenderSettings& settings, double weight, const FlakeBuffers& buffers);

    void draw(const FlakeDraw& what) const;

    /// Largest flake diameter (m) before flake_scale; docs/drawing.md.
    static constexpr double kLargestDiameter = 0.020;
    /// Radius (px) from which a flake shows its crystal.
    static constexpr double kCrystalRadius = 3.0;

  private:
    enum Detail : std::size_t
    {
        kPlain,
        kCrystal,
    };
    void bind(const FlakeDraw& what) const;
    void set_blending() const;
    GLsizei count_beyond(const FlakeDraw& what, double border_m) const;
    void use(const FlakeDraw& what, Detail detail) const;
    void draw_range(const FlakeDraw& what, Detail detail, GLsizei first, GLsizei count) const;
    void draw_points(const FlakeDraw& what) const;

    scene::RenderSettings settings_;
    const FlakeBuffers& buffers_;
    std::array<ByAir, 2> programs_;    // by Detail
    std::optional<FlakeSplit> split_;  // where the host cannot read the buffers
    VertexArray nothing_;
};

}  // namespace spindrift::gl
