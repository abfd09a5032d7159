// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "scene/flow_field.h"

namespace spindrift::scene
{

namespace
{

using Root = std::array<double, 6>;  ///< s11 s21 s22 s31 s32 s33

Root root_of(const Stress<float>& t)
{
    const Stress<double> wide{t.xx, t.xy, t.xz, t.yy, t.yz, t.zz};
    const StressRoot<double> s = stress_root(realizable(wide));
    return {s.s11, s.s21, s.s22, s.s31, s.s32, s.s33};
}

/// For every cell the cell whose turbulence it has: itself if fluid, else the nearest fluid one counted in
/// faces.
std::vector<std::uint32_t> turbulence_source(const FlowField& flow)
{
    constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    const GridSize n = flow.size;
    std::vector<std::uint32_t> source(n.count(), kNone);
    std::deque<std::uint32_t> front;
    for (std::uint32_t i = 0; i < source.size(); ++i)
        if (flow.solid[i] == 0)
        {
            source[i] = i;
            front.push_back(i);
        }
    const auto nx = static_cast<std::uint32_t>(n.nx), ny = static_cast<std::uint32_t>(n.ny),
               nz = static_cast<std::uint32_t>(n.nz);
    while (!front.empty())
    {
        const std::uint32_t i = front.front();
        front.pop_front();
        const auto pass = [&](bool inside, std::uint32_t neighbour)
        {
            if (!inside || source[neighbour] != kNone) return;
            source[neighbour] = source[i];
            front.push_back(neighbour);
        };
        const std::uint32_t x = i % nx, y = i / nx % ny, z = i / nx / ny;
        pass(x > 0, i - 1);
        pass(x + 1 < nx, i + 1);
        pass(y > 0, i - nx);
        pass(y + 1 < ny, i + nx);
        pass(z > 0, i - nx * ny);
        pass(z + 1 < nz, i + nx * ny);
    }
    for (std::uint32_t i = 0; i < source.size(); ++i)
        if (source[i] == kNone) source[i] = i;  // nothing is fluid
    return source;
}

float narrow(double v)
{
    return static_cast<float>(std::clamp(v, -1e9, 1e9));
}

class Records
{
  public:
    explicit Records(const FlowField& flow) : flow_(flow), source_(turbulence_source(flow))
    {
        roots_.resize(flow.size.count());
        for (std::size_t i = 0; i < roots_.size(); ++i)
            if (source_[i] == i) roots_[i] = root_of(flow.stress[i]);
        for (std::size_t i = 0; i < roots_.size(); ++i) roots_[i] = roots_[source_[i]];
    }

    void fill(int x, int y, int z, WindCell& cell) const
    {
        const std::size_t i = flow_.size.index(x, y, z);
        const Root& s = roots_[i];
        cell.s11 = narrow(s[0]), cell.s21 = narrow(s[1]), cell.s22 = narrow(s[2]);
        cell.s31 = narrow(s[3]), cell.s32 = narrow(s[4]), cell.s33 = narrow(s[5]);
        cell.c0_eps = std::max(narrow(static_cast<double>(flow_.c0_eps[source_[i]])), 0.0F);
        const Root dx = slope(i, x, flow_.size.nx, 1, flow_.cell_m.x);
        const Root dy = slope(i, y, flow_.size.ny, static_cast<std::size_t>(flow_.size.nx), flow_.cell_m.y);
        const Root dz =
            slope(i, z, flow_.size.nz,
                  static_cast<std::size_t>(flow_.size.nx) * static_cast<std::size_t>(flow_.size.ny),
                  flow_.cell_m.z);
        cell.div_s1 = narrow(dx[0] + dy[1] + dz[3]);  // column 1 is s11 s21 s31
        cell.div_s2 = narrow(dy[2] + dz[4]);          // column 2 is 0 s22 s32
        cell.div_s3 = narrow(dz[5]);                  // column 3 is 0 0 s33
        double steepest = 0;
        for (const Root* d : {&dx, &dy, &dz})
            for (const double v : *d) steepest = std::max(steepest, std::abs(v));
        cell.gradient = narrow(steepest);
    }

  private:
    Root slope(std::size_t i, int at, int n, std::size_t stride, double cell_m) const
    {
        const std::size_t high = at + 1 < n ? i + stride : i, low = at > 0 ? i - stride : i;
        Root d{};
        if (high == low) return d;
        const double per_m = 1.0 / (cell_m * (high != i && low != i ? 2 : 1));
        for (std::size_t k = 0; k < d.size(); ++k) d[k] = (roots_[high][k] - roots_[low][k]) * per_m;
        return d;
    }

    const FlowField& flow_;
    std::vector<std::uint32_t> source_;
    std::vector<Root> roots_;
};

}  // namespace

void fill_wind_grid(const FlowField& flow, Wind& wind)
{
    const GridSize n = flow.size;
    const auto f = [](double v) { return static_cast<float>(v); };
    wind.kind = WindKind::grid;
    wind.turbulent = !flow.stress.empty();
    wind.nx = n.nx;
    wind.ny = n.ny;
    wind.nz = n.nz;
    const Vec3d first = flow.low_m + flow.cell_m * 0.5;
    wind.origin_m = {f(first.x), f(first.y), f(first.z)};
    wind.cell_m = {f(flow.cell_m.x), f(flow.cell_m.y), f(flow.cell_m.z)};
    wind.cells.assign(n.count(), WindCell{});
    for (std::size_t i = 0; i < wind.cells.size(); ++i)
        if (flow.solid[i] == 0)
        {
            wind.cells[i].u = flow.mean[i].x;
            wind.cells[i].v = flow.mean[i].y;
            wind.cells[i].w = flow.mean[i].z;
        }
    if (!wind.turbulent) return;
    const Records records(flow);
    for (int z = 0; z < n.nz; ++z)
        for (int y = 0; y < n.ny; ++y)
            for (int x = 0; x < n.nx; ++x) records.fill(x, y, z, wind.cells[n.index(x, y, z)]);
}

}  // namespace spindrift::scene
