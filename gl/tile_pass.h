// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/backend.h"
#include "core/splatter.h"
#include "core/world.h"
#include "gl/flake_buffers.h"
#include "gl/picture.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// Draws flakes by a Splatter: fetches scene and depth from GL, has the sprites blended, and where nothing
/// comes after has the picture developed too. Fast where GL's memory is the processor's own.
class TilePass
{
  public:
    TilePass(const scene::Scene& scene, const World& world, const FlakeBuffers& buffers);
    TilePass(const TilePass&) = delete;
    TilePass& operator=(const TilePass&) = delete;

    /// What of a frame it depends on.
    struct Frame
    {
        const View& view;
        const DrawList& list;
        const std::vector<Lamp<float>>& lamps;
        LampClusters clusters;
        GlowGrids glow;
        Vec3f ambient;  ///< of flakes
        SplatAir air;
        LampShadows shadows;
        double time_s;
        const Vec3f* velocities;  ///< with a shutter time
    };
    /// The light alone, into picture.linear.
    void blend(Splatter& splatter, const Frame& frame, const Picture& picture);
    /// Light and display picture. The light stays here until bring_back.
    void blend_and_develop(Splatter& splatter, const Frame& frame, const Picture& picture);
    /// Moves light that blend_and_develop kept into picture.linear.
    void bring_back(const Picture& picture);
    /// Forgets it: a new frame begins.
    void discard() { holds_light_ = false; }

  private:
    SplatJob job(const Frame& frame) const;
    SplatPicture fetch(const Picture& picture);

    scene::RenderSettings settings_;
    FlakeSizes sizes_;
    float real_flakes_;
    float extinction_per_m_;
    const FlakeBuffers& buffers_;
    CrystalTexels crystals_;  ///< into texels_
    std::vector<std::uint8_t> texels_;
    bool dither_;
    std::vector<std::uint16_t> tone_;
    std::vector<std::uint8_t> noise_;  ///< by pixel of the picture that display_ is for
    int noise_width_ = 0;
    std::vector<float> depth_;
    std::vector<std::uint16_t> rgba_;
    std::vector<std::uint8_t> display_;
    bool holds_light_ = false;
};

}  // namespace spindrift::gl
