// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "gl/float_target.h"
#include "gl/full_screen_pass.h"
#include "gl/object.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// Keeps the factor on all light where the later passes read it: as the scene sets it, or found from the
/// picture and followed in time (core/exposure.h), without a word to the host.
class ExposurePass
{
  public:
    ExposurePass(const scene::RenderSettings& settings, int width_px, int height_px);

    /// Finds the exposure of the picture anew. `time_s` is its display time: the first picture, and one that
    /// is shown before the last one, are adapted to at once.
    void draw(GLuint linear, double time_s);
    /// Where the passes that follow read it.
    void bind() const;
    void resize(int width_px, int height_px);

    /// The factor of the last picture; waits for the GPU.
    double exposure() const;

  private:
    scene::RenderSettings settings_;
    FullScreenPass meter_, expose_;
    FloatTarget blocks_, nowhere_;
    Buffer block_;
    std::optional<double> last_time_s_;
};

}  // namespace spindrift::gl
