// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/vec.h"

namespace spindrift::scene
{

/// Which unit cells [x, x+1] x [y, y+1] x [z, z+1] a triangle touches; coordinates in cells. The separating
/// axes are arranged as by Schwarz & Seidel 2010, "Fast parallel surface and solid voxelization",
/// section 3.1.
class TriangleCells
{
  public:
    TriangleCells(const Vec3d& a, const Vec3d& b, const Vec3d& c) : corner_{a, b, c}
    {
        normal_ = cross(b - a, c - b);
        const Vec3d reach{normal_.x > 0 ? 1.0 : 0.0, normal_.y > 0 ? 1.0 : 0.0, normal_.z > 0 ? 1.0 : 0.0};
        near_ = dot(normal_, reach - a);
        far_ = dot(normal_, Vec3d{1, 1, 1} - reach - a);
        for (int plane = 0; plane < 3; ++plane)
            for (int edge = 0; edge < 3; ++edge) set_edge(plane, edge);
    }

    Vec3d low() const
    {
        return extreme([](double p, double q) { return std::min(p, q); });
    }
    Vec3d high() const
    {
        return extreme([](double p, double q) { return std::max(p, q); });
    }

    /// Only for cells within the triangle's bounding box.
    bool touches(int x, int y, int z) const
    {
        const Vec3d p{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        const double at = dot(normal_, p);
        if ((at + near_) * (at + far_) > 0) return false;
        for (int plane = 0; plane < 3; ++plane)
        {
            const double u = component(p, plane), v = component(p, (plane + 1) % 3);
            for (const Edge& e : edge_[plane])
                if (e.nu * u + e.nv * v + e.d < 0) return false;
        }
        return true;
    }

  private:
    struct Edge
    {
        double nu, nv, d;
    };

    static double component(const Vec3d& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

    /// The projection along the axis left over from (u, v) = (xy, yz, zx)[plane].
    void set_edge(int plane, int edge)
    {
        const int u = plane, v = (plane + 1) % 3, w = (plane + 2) % 3;
        const Vec3d& from = corner_[edge];
        const Vec3d along = corner_[(edge + 1) % 3] - from;
        const double sign = component(normal_, w) >= 0 ? 1 : -1;
        const double nu = -component(along, v) * sign, nv = component(along, u) * sign;
        const double d =
            -(nu * component(from, u) + nv * component(from, v)) + std::max(nu, 0.0) + std::max(nv, 0.0);
        edge_[plane][edge] = {nu, nv, d};
    }

    template <class Choose>
    Vec3d extreme(Choose choose) const
    {
        const auto& [a, b, c] = corner_;
        return {choose(a.x, choose(b.x, c.x)), choose(a.y, choose(b.y, c.y)), choose(a.z, choose(b.z, c.z))};
    }

    std::array<Vec3d, 3> corner_;
    Vec3d normal_{};
    double near_ = 0, far_ = 0;
    std::array<std::array<Edge, 3>, 3> edge_;
};

}  // namespace spindrift::scene
