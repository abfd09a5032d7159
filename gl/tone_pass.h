// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "gl/bloom_pass.h"
#include "gl/full_screen_pass.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// Bloom mixed in, tone curve, sRGB, dither: into whatever 8-bit target is bound.
class TonePass
{
  public:
    explicit TonePass(const scene::Scene& scene);

    /// The exposure must be bound. `bloom`: null where the frame has none.
    void draw(GLuint linear, const BloomPass* bloom) const;

  private:
    const FullScreenPass& variant(bool blooms) const;

    scene::BloomSettings bloom_;
    Tone<double> tone_;
    bool dither_;
    Sampler sampler_;
    mutable std::array<std::optional<FullScreenPass>, 2> variants_;  ///< without and with bloom
};

}  // namespace spindrift::gl
