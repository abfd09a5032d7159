// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "gl/full_screen_pass.h"
#include "gl/object.h"
#include "gl/picture.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// What flakes are drawn into that are blended without a sort, weighted or stochastic, and how the picture
/// gets them from there. Stochastic ones are drawn in several passes if a texel holds fewer samples than are
/// asked for.
class UnsortedTarget
{
  public:
    UnsortedTarget(const scene::RenderSettings& settings, const Picture& picture);

    /// The samples that a pass draws.
    struct Samples
    {
        int first, count, all;
    };
    int passes() const { return samples_ / samples_a_pass_; }
    Samples samples(int pass) const { return {pass * samples_a_pass_, samples_a_pass_, samples_}; }

    /// Clears what flakes are drawn into next, with the scene's depth from `picture`.
    void begin(const Picture& picture) const;
    void end() const;
    /// Puts all passes over the picture.
    void compose(const Picture& picture) const;

  private:
    void attach_shared(const Picture& picture);
    void attach_sampled(const Picture& picture);
    bool sampled() const { return flakes_.name() != 0; }

    int width_, height_;
    int samples_ = 1, samples_a_pass_ = 1;
    Texture sum_;   ///< of radiance; alpha: of weights, or share that is covered
    Texture left_;  ///< weighted: share of what lies behind
    Framebuffer target_;
    Texture flakes_, flakes_depth_;  ///< stochastic: several samples a texel
    Framebuffer sum_target_;         ///< stochastic: sum_ alone
    FullScreenPass compose_;
    std::optional<FullScreenPass> depth_, add_;
};

}  // namespace spindrift::gl
