// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/stage_log.h"
#include "gl/renderer.h"
#include "image/write.h"
#include "scene/scene.h"

namespace spindrift::app
{

/// What is put to the left of a picture.
enum class Beside
{
    nothing,
    low_range,  ///< the same as 8 bits would hold it
};

/// The picture files of a run: one simulation may feed several. A frame is read back at most once in each of
/// the two forms.
class Outputs
{
  public:
    /// Opens every output. Throws Error for one that cannot be written, before anything is simulated.
    Outputs(const std::vector<std::string>& patterns, const scene::RenderSettings& render, Beside beside);

    void add(gl::Renderer& renderer, StageLog& log);
    void finish(StageLog& log);
    bool empty() const { return writers_.empty(); }

  private:
    image::Image8 display_of(gl::Renderer& renderer) const;

    Beside beside_;
    std::vector<std::unique_ptr<image::FrameWriter>> writers_;
};

}  // namespace spindrift::app
