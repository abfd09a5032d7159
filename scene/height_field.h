// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "core/vec.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::scene
{

/// Heights over the domain from a grey PNG: its middle-of-pixel grid is stretched so that the outermost
/// pixels lie on the border of the domain; the picture's top is north (+y). Local frame, metres.
class HeightField
{
  public:
    /// Throws Error for a missing, broken or coloured picture.
    HeightField(const GroundSettings& ground, const DomainSettings& domain,
                const std::filesystem::path& folder);

    /// Bilinear; held outside of the domain.
    double height_m(double x_m, double y_m) const;

    /// A grid of at most 1025 x 1025 vertices.
    Mesh mesh() const;

  private:
    double value(int column, int row) const;

    int width_ = 0, height_ = 0;
    std::vector<std::uint16_t> grey_;  ///< rows from the south
    double datum_m_, relief_m_, size_x_m_, size_y_m_;
    Surface surface_;
    Colour albedo_;
};

}  // namespace spindrift::scene
