// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "gl/bloom_shape.h"
#include "gl/float_target.h"
#include "gl/full_screen_pass.h"
#include "gl/object.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// Spreads the bright part of a picture by one of five methods. The first pass, which finds it, arms the draw
/// calls of the rest on the GPU: of a picture with nothing bright the rest draws nothing, exactly and without
/// asking the host.
class BloomPass
{
  public:
    BloomPass(const scene::BloomSettings& settings, int width_px, int height_px);

    /// The exposure must be bound. Leaves the result in spread(), if anything was bright.
    void draw(GLuint linear) const;

    /// What the last pass wrote: texels lie shape().first_scale pixels apart, or shape().scale (reduced).
    const FloatTarget& spread() const { return *spread_; }
    double spread_scale() const { return spread_scale_; }
    /// Of its first word, 0 when nothing was bright.
    GLuint command() const { return command_.name(); }
    /// Whether the last picture had anything bright; waits for the GPU.
    bool found_bright() const;

  private:
    /// One draw call of the chain.
    struct Step
    {
        const FullScreenPass* pass;
        const FloatTarget* from;
        const FloatTarget* to;
        GLuint sampler;  ///< 0: texel by texel
    };
    const FullScreenPass& program(std::string_view fragment_file,
                                  std::span<const std::string_view> defines = {});
    const FloatTarget& target(int scale_x, int scale_y);
    void add(const FullScreenPass& pass, const FloatTarget& to, GLuint sampler = 0);
    void add_gauss();
    void add_reduction();
    void add_pyramid();

    scene::BloomSettings settings_;
    int width_px_, height_px_;
    BloomShape shape_;
    std::deque<FullScreenPass> programs_;
    std::deque<FloatTarget> targets_;
    Sampler dark_outside_, to_the_edge_;
    FullScreenPass bright_;
    const FloatTarget* first_;
    const FloatTarget* spread_;
    double spread_scale_;
    std::vector<Step> steps_;
    Buffer command_;
};

/// The uniform `bright_in` of shaders/develop.vert.
glm::vec3 bright_uniform(const scene::BloomSettings& settings);

}  // namespace spindrift::gl
