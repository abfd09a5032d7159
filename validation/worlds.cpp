// SPDX-License-Identifier: MIT
#include "validation/worlds.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/flow_field.h"

namespace spindrift::validation
{

AirLevel isotropic(double sigma_m_s, double rate_per_s)
{
    const double variance = sigma_m_s * sigma_m_s;
    return {{}, {variance, 0, 0, variance, 0, variance}, 2 * variance * rate_per_s};
}

Wind wind_along(Along axis, double low_m, double cell_m, int n, const std::function<AirLevel(double)>& air_at)
{
    scene::FlowField flow;
    flow.size = axis == Along::x ? GridSize{n, 1, 1} : GridSize{1, 1, n};
    flow.low_m = axis == Along::x ? Vec3d{low_m, 0, 0} : Vec3d{0, 0, low_m};
    flow.cell_m = {cell_m, cell_m, cell_m};
    flow.solid.assign(flow.size.count(), 0);
    const auto f = [](double v) { return static_cast<float>(v); };
    for (int i = 0; i < n; ++i)
    {
        const AirLevel air = air_at(low_m + (i + 0.5) * cell_m);
        const Stress<double>& t = air.stress;
        flow.mean.push_back({f(air.mean_m_s.x), f(air.mean_m_s.y), f(air.mean_m_s.z)});
        flow.stress.push_back({f(t.xx), f(t.xy), f(t.xz), f(t.yy), f(t.yz), f(t.zz)});
        flow.c0_eps.push_back(f(air.c0_eps));
    }
    Wind wind;
    scene::fill_wind_grid(flow, wind);
    return wind;
}

Wind wind_everywhere(const AirLevel& air)
{
    return wind_along(Along::z, 0, 1, 1, [&](double) { return air; });
}

World empty_world(const Settings& settings, double step_s, Vec3f size_m)
{
    World w;
    w.size_m = size_m;
    w.on_leave = OnLeave::wrap;
    w.step_s = step_s;
    w.seed = settings.seed;
    w.capacity = settings.particles;
    w.has_ground = false;
    w.snow.fall_speed_m_s = 0;
    w.snow.fall_speed_spread_m_s = 0;
    return w;
}

void add_ground(World& world)
{
    world.has_ground = true;
    world.ground_m = 0;
    world.ground = {Contact::bounce, 1};
}

void add_lid(World& world, float height_m, float cell_m)
{
    VoxelGrid& v = world.voxels;
    const auto cells = [&](float length)
    { return std::max(1, static_cast<int>(std::ceil(length / cell_m))); };
    v.nx = cells(world.size_m.x), v.ny = cells(world.size_m.y);
    v.nz = static_cast<int>(std::lround(height_m / cell_m)) + 1;
    v.cell_m = cell_m;
    const std::size_t layer = static_cast<std::size_t>(v.nx) * static_cast<std::size_t>(v.ny);
    for (int z = 0; z < v.nz; ++z)
        v.clearance.insert(v.clearance.end(), layer, static_cast<std::uint8_t>(std::min(v.nz - 1 - z, 255)));
    v.surface.assign(v.clearance.size(), 0);
    world.surfaces = {{Contact::bounce, 1}};
    world.size_m.z = cell_m * static_cast<float>(v.nz);
}

void add_burst(World& world, Vec3f low, Vec3f high)
{
    const bool point = low.x == high.x && low.y == high.y && low.z == high.z;
    Emitter e;
    e.shape = point ? EmitterShape::point : EmitterShape::box;
    e.a = low, e.b = high;
    e.burst = world.capacity;
    world.emitters.push_back(e);
}

FlakeRun::FlakeRun(const World& world, const Settings& settings, cpu::CpuOptions options)
    : memory_(world.capacity), flakes_(memory_.flakes())
{
    if (options.threads == 0) options.threads = settings.threads;
    backend_ = cpu::make_cpu_backend(world, flakes_, memory_.draw_list(), options);
}

void FlakeRun::steps(std::uint64_t n)
{
    for (std::uint64_t i = 0; i < n; ++i) backend_->step();
}

std::uint64_t FlakeRun::rogue() const
{
    const FlakeCounts c = backend_->counts();
    const std::uint64_t found = c.alive + c.left + c.landed + c.vanished;
    return backend_->extent().rogue + (c.emitted > found ? c.emitted - found : found - c.emitted);
}

std::string short_number(double value)
{
    return fmt::format("{:g}", value);
}

}  // namespace spindrift::validation
