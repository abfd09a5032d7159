// SPDX-License-Identifier: MIT
#include "bench/windy_box.h"

#include <cmath>

namespace spindrift::bench
{

namespace
{

constexpr float kCell = 2;  // m

/// A town-sized wind: mean shear, a wake-like wave, stresses that vary over tens of metres.
WindCell cell_at(float x, float y, float z)
{
    const float wave = std::sin(0.05F * x) * std::cos(0.04F * y);
    const float slope = 0.05F * std::cos(0.05F * x) * std::cos(0.04F * y);
    WindCell c{};
    c.u = 3 + 1.5F * std::log1p(z) + wave, c.v = wave, c.w = 0.1F * wave;
    c.s11 = 1.5F + 0.3F * wave, c.s22 = 1.2F, c.s33 = 0.8F, c.s31 = -0.2F;
    c.div_s1 = 0.3F * slope;
    c.gradient = 0.02F;
    c.c0_eps = 5.0F / (1 + z);
    return c;
}

World box_of_flakes(std::uint64_t flakes, bool turbulent)
{
    World w;
    w.size_m = {128 * kCell, 128 * kCell, 64 * kCell};
    w.on_leave = OnLeave::wrap;
    w.capacity = flakes;
    w.has_ground = false;
    w.wind.turbulent = turbulent;
    Emitter e;
    e.shape = EmitterShape::box;
    e.b = w.size_m;
    e.burst = flakes;
    w.emitters.push_back(e);
    return w;
}

}  // namespace

World windy_box(std::uint64_t flakes, bool turbulent)
{
    World w = box_of_flakes(flakes, turbulent);
    w.wind.kind = WindKind::grid;
    w.wind.nx = 128, w.wind.ny = 128, w.wind.nz = 64;
    w.wind.origin_m = {kCell / 2, kCell / 2, kCell / 2};
    w.wind.cell_m = {kCell, kCell, kCell};
    for (int z = 0; z < 64; ++z)
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x)
                w.wind.cells.push_back(cell_at(kCell * (static_cast<float>(x) + 0.5F),
                                               kCell * (static_cast<float>(y) + 0.5F),
                                               kCell * (static_cast<float>(z) + 0.5F)));
    return w;
}

World profile_box(std::uint64_t flakes, bool turbulent)
{
    World w = box_of_flakes(flakes, turbulent);
    w.wind.kind = WindKind::logarithmic;
    return w;
}

}  // namespace spindrift::bench
