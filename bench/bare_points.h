// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace spindrift::bench
{

/// One point as the rasteriser sees it.
struct BarePoint
{
    float x, y;     ///< px from the lower left corner of the picture
    float size_px;  ///< edge of its square
    float unused = 0;
};

/// The floor that drawing flakes is held against: the same points at the same places and sizes in the same
/// order, blended in one colour into a float target, with nothing computed per vertex or pixel. Needs a
/// current context while it lives.
class BarePoints
{
  public:
    BarePoints(int width_px, int height_px);
    ~BarePoints();
    BarePoints(const BarePoints&) = delete;
    BarePoints& operator=(const BarePoints&) = delete;

    void upload(const std::vector<BarePoint>& points);
    /// Until the points are there.
    void draw() const;

  private:
    int width_px_, height_px_;
    std::uint32_t program_ = 0, buffer_ = 0, vertex_array_ = 0, texture_ = 0, target_ = 0;
    int count_ = 0;
};

}  // namespace spindrift::bench
