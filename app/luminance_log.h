// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gl/renderer.h"
#include "scene/scene.h"

namespace spindrift::app
{

/// Luminance of some pixels in cd/m2, frame by frame: what the scene sends out and what a calibrated display
/// gives off.
class LuminanceLog
{
  public:
    /// Throws Error for a pixel outside of the picture, and for pixels of a scene without a calibration.
    LuminanceLog(const scene::Scene& scene, const std::vector<std::array<int, 2>>& pixels);

    void add(const gl::Renderer& renderer, std::uint64_t frame, double time_s);
    /// A heading and a line for each frame and pixel.
    std::span<const std::byte> csv() const { return std::as_bytes(std::span(text_)); }

  private:
    scene::DisplaySettings display_;
    std::vector<std::array<int, 2>> pixels_;
    std::string text_;
};

}  // namespace spindrift::app
