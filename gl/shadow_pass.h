// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/light.h"
#include "core/shadow.h"
#include "core/world.h"
#include "gl/flake_buffers.h"
#include "gl/lamp_lens.h"
#include "gl/lit_program.h"
#include "gl/object.h"
#include "gl/program.h"
#include "gl/scene_pass.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// Maps of what lamps see, the scene's nearest depth and the optical depth of the flakes in slices, and the
/// block by which every lit shader looks them up. They are kept until they are drawn anew.
class ShadowPass
{
  public:
    ShadowPass(const scene::Scene& scene, const scene::Geometry& geometry, const World& world);

    /// Makes room for their maps and turns to the first. Before draw_scene is timed: software GL counts from
    /// the start of the machine where a query begins before a target has been drawn to.
    void turn_to_maps(const std::vector<Lamp<float>>& lamps);
    /// The scene's maps of the lamps that cast shadows: the first of `lamps`.
    void draw_scene(const ScenePass& solids, const std::vector<Lamp<float>>& lamps, double time_s);
    /// The snow's slices of the same lamps, from every living flake of the first `slots`. `in_fog`: the air's
    /// extinction dims spots already.
    void draw_snow(const FlakeBuffers& flakes, std::uint64_t slots, const std::vector<Lamp<float>>& lamps,
                   double time_s, bool in_fog);
    /// For the shaders of `lit`; does nothing without shadows.
    void bind(const LitBy& lit);
    /// The maps in the host's memory, until they are drawn anew.
    LampShadows on_host(const LitBy& lit);

  private:
    void make_maps(std::size_t lamps);
    void make_slices(std::size_t lamps);
    void deposit(const FlakeBuffers& flakes, std::uint64_t slots, std::size_t lamp) const;
    void upload();

    scene::Scene scene_;
    CasterBox casters_;
    float mean_melted_mm_;
    std::uint64_t seed_;
    double cover_;  ///< area that a flake hides over its squared radius
    Program depth_program_, deposit_, sum_;
    Texture maps_, snow_;
    std::size_t map_room_ = 0, snow_room_ = 0;  ///< lamps
    std::vector<Framebuffer> targets_;
    Buffer cells_, block_;
    Sampler compare_, linear_;
    LampShadows known_;  ///< lenses, sizes; its pointers once fetched
    std::vector<float> host_maps_, host_snow_;
    bool maps_fetched_ = false, snow_fetched_ = false, uploaded_ = false;
};

}  // namespace spindrift::gl
