// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "core/splatter.h"
#include "gl/frame_plan.h"
#include "gl/lit_program.h"
#include "gl/object.h"
#include "scene/air.h"

namespace spindrift::gl
{

/// Lays the fog that snow-filled air is over scene and sky, and the glow of lamps in it; keeps what flakes
/// need to be seen through it.
class AirPass
{
  public:
    explicit AirPass(const scene::Scene& scene);

    /// Brings the air of a frame to the shaders' block. Does nothing in clear air.
    void prepare(const FramePlan& plan, const View& view, double time_s);
    /// Over the bound target; `depth` is that of the scene, which must not be its attachment.
    void draw_fog(GLuint depth, const LitBy& lit) const { draw(fog_, depth, lit); }
    void draw_airlight(GLuint depth, const LitBy& lit) const { draw(airlight_, depth, lit); }

    /// The air before flakes that a Splatter blends, until the next prepare(). Not thick in clear air.
    SplatAir before_flakes() const;

  private:
    void draw(const LitProgram& program, GLuint depth, const LitBy& lit) const;
    void upload() const;

    scene::Scene scene_;
    LitProgram fog_, airlight_;
    VertexArray nothing_;
    Buffer block_;
    std::optional<View> lens_;  ///< for which air_ was made
    scene::Air air_;
    std::vector<float> area_m2_, integral_m3_;
    bool thick_ = false, glows_ = false;
};

}  // namespace spindrift::gl
