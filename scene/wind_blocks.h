// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/urban_zones.h"
#include "core/vec.h"

namespace spindrift::scene
{

/// What stands in the wind, from above: outlines (convex, any order of turning) between two heights, local
/// frame.
struct Footprint
{
    std::vector<std::vector<Vec3d>> outlines;  ///< z unused
    double base_m = 0, top_m = 0;
    double ground_m = 0;  ///< of the terrain at its foot
};

/// A footprint as one direction of wind meets it: along `to` counts s, across it (to the left) t.
class WindBlock
{
  public:
    /// `to`: unit vector; `strip_m`: resolution across the wind.
    WindBlock(const Footprint& footprint, Vec3d to, double strip_m);

    struct Strip
    {
        double front, lee;  ///< smallest and largest s; front > lee: nothing
        bool any() const { return front <= lee; }
    };

    const BlockSize<double>& size() const { return size_; }
    double base_m() const { return base_m_; }
    double top_m() const { return top_m_; }
    double ground_m() const { return ground_m_; }
    const Vec3d& to() const { return to_; }
    double front() const { return front_; }    ///< smallest s of all
    double lee() const { return lee_; }        ///< largest
    double middle() const { return middle_; }  ///< t
    double s(const Vec3d& p) const { return p.x * to_.x + p.y * to_.y; }
    double t(const Vec3d& p) const { return p.y * to_.x - p.x * to_.y; }

    /// The strip at t; one without anything beside the block.
    Strip strip(double t) const;

    /// Whether its front stands square to the wind (within 15 degrees), so that air separates at its edges.
    bool square() const { return square_; }

  private:
    void add(const std::vector<Vec3d>& outline, double strip_m);

    Vec3d to_;
    double base_m_, top_m_, ground_m_, front_, lee_, low_t_, strip_m_, middle_ = 0;
    BlockSize<double> size_{};
    bool square_ = false;
    std::vector<Strip> strips_;
};

}  // namespace spindrift::scene
