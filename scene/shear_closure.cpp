// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/flow_field.h"

namespace spindrift::scene
{

namespace
{

/// Largest local friction velocity over that of the undisturbed wind: (2.5 * 1.8)^2 = 20.
constexpr double kMostFriction = 1.8;

class Shear
{
  public:
    Shear(const ShearClosure& closure, FlowField& flow)
        : closure_(closure),
          flow_(flow),
          to_wall_(euclidean_distance(flow.size, flow.cell_m, flow.solid)),
          least_cell_(std::min({flow.cell_m.x, flow.cell_m.y, flow.cell_m.z}))
    {
    }

    void fill(int x, int y, int z)
    {
        const std::size_t i = flow_.size.index(x, y, z);
        if (flow_.solid[i] != 0) return;
        const double height = (z + 0.5) * flow_.cell_m.z;
        const double d = std::max(std::min(height, static_cast<double>(to_wall_[i]) - 0.5 * least_cell_),
                                  0.5 * least_cell_);
        const Vec3f& mean = flow_.mean[i];
        const std::array<double, 3> u{mean.x, mean.y, mean.z};
        const Stress<double> rate = strain(x, y, z, i);
        const double size = std::sqrt(2 * (rate.xx * rate.xx + rate.yy * rate.yy + rate.zz * rate.zz) +
                                      4 * (rate.xy * rate.xy + rate.xz * rate.xz + rate.yz * rate.yz));
        const double z0 = closure_.roughness_m;
        const double speed = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        const bool beside_wall = d < least_cell_;
        const double given =
            beside_wall ? kVonKarman * speed / std::log((d + z0) / z0) : kVonKarman * (d + z0) * size;
        const double friction = std::min(given, kMostFriction * closure_.friction_velocity_m_s);
        const double part = height / closure_.boundary_layer_m;
        const double left = layer_share(part);
        flow_.stress[i] = stress(friction * friction * left * std::sqrt(left), u[0], u[1], rate, size);
        flow_.c0_eps[i] = static_cast<float>(neutral_dissipation(friction, d) * dissipation_decline(part));
    }

  private:
    static Stress<float> stress(double friction2, double u, double v, const Stress<double>& rate, double size)
    {
        const double level = std::sqrt(u * u + v * v);
        const Stress<double> normal =
            neutral_normal_stress(level > 0 ? u / level : 1.0, level > 0 ? v / level : 0.0);
        const double shear = size > 0 ? -2 / size : 0.0;  // -2 nu_T S_ij over u*^2
        const auto f = [&](double n, double s) { return static_cast<float>(friction2 * (n + shear * s)); };
        return {f(normal.xx, 0), f(normal.xy, rate.xy), f(normal.xz, rate.xz),
                f(normal.yy, 0), f(normal.yz, rate.yz), f(normal.zz, 0)};
    }

    /// S_ij = (d_i U_j + d_j U_i) / 2, 1/s.
    Stress<double> strain(int x, int y, int z, std::size_t i) const
    {
        const std::size_t row = static_cast<std::size_t>(flow_.size.nx);
        const auto linear = [](double cell_m) { return [cell_m](int k) { return cell_m * k; }; };
        const Vec3d dx = slope(i, x, flow_.size.nx, 1, linear(flow_.cell_m.x));
        const Vec3d dy = slope(i, y, flow_.size.ny, row, linear(flow_.cell_m.y));
        // differences over ln(z + z0) are exact in a logarithmic profile
        const double z0 = closure_.roughness_m, dz_m = flow_.cell_m.z;
        const Vec3d dz = slope(i, z, flow_.size.nz, row * static_cast<std::size_t>(flow_.size.ny),
                               [&](int k) { return std::log((k + 0.5) * dz_m + z0); }) *
                         (1 / ((z + 0.5) * dz_m + z0));
        return {dx.x, 0.5 * (dx.y + dy.x), 0.5 * (dx.z + dz.x), dy.y, 0.5 * (dy.z + dz.y), dz.z};
    }

    /// Difference quotient of the mean over the fluid neighbours along one axis; zero without any.
    template <class Position>
    Vec3d slope(std::size_t i, int at, int n, std::size_t stride, Position position) const
    {
        const bool up = at + 1 < n && flow_.solid[i + stride] == 0,
                   down = at > 0 && flow_.solid[i - stride] == 0;
        if (!up && !down) return {0, 0, 0};
        const Vec3f &high = flow_.mean[up ? i + stride : i], &low = flow_.mean[down ? i - stride : i];
        const double per = 1 / (position(up ? at + 1 : at) - position(down ? at - 1 : at));
        return Vec3d{static_cast<double>(high.x) - low.x, static_cast<double>(high.y) - low.y,
                     static_cast<double>(high.z) - low.z} *
               per;
    }

    const ShearClosure& closure_;
    FlowField& flow_;
    std::vector<float> to_wall_;
    double least_cell_;
};

}  // namespace

void close_from_shear(const ShearClosure& closure, FlowField& flow)
{
    flow.stress.assign(flow.size.count(), {});
    flow.c0_eps.assign(flow.size.count(), 0);
    Shear shear(closure, flow);
    for (int z = 0; z < flow.size.nz; ++z)
        for (int y = 0; y < flow.size.ny; ++y)
            for (int x = 0; x < flow.size.nx; ++x) shear.fill(x, y, z);
}

}  // namespace spindrift::scene
