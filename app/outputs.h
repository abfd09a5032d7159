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
/// the two forms, and not at all where only the last frame is wanted.
class Outputs
{
  public:
    /// Opens every output. Throws Error for one that cannot be written, before anything is simulated.
    Outputs(const std::vector<std::string>& patterns, const scene::RenderSettings& render, Beside beside);

    /// Takes the frame that the renderer has drawn.
    void add(gl::Renderer& renderer, StageLog& log);
    /// Completes the files; the renderer still holds the last frame, if one was drawn.
    void finish(gl::Renderer& renderer, StageLog& log);
    bool empty() const { return writers_.empty(); }

  private:
    image::Image8 display_of(gl::Renderer& renderer) const;
    /// Gives the renderer's picture to the writers that keep the last frame only, or to the others.
    void give(gl::Renderer& renderer, StageLog& log, bool last_only);

    Beside beside_;
    bool drawn_ = false;
    std::vector<std::unique_ptr<image::FrameWriter>> writers_;
};

}  // namespace spindrift::app
