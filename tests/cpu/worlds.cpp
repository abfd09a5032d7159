// SPDX-License-Identifier: MIT
#include "worlds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spindrift::cpu::test
{

VoxelGrid voxels(int nx, int ny, int nz, float cell_m, const std::function<bool(int, int, int)>& solid,
                 const std::function<std::uint8_t(int, int, int)>& surface)
{
    VoxelGrid grid;
    grid.nx = nx, grid.ny = ny, grid.nz = nz, grid.cell_m = cell_m;
    const auto index = [&](int x, int y, int z) { return static_cast<std::size_t>((z * ny + y) * nx + x); };
    const auto n = static_cast<std::size_t>(nx * ny * nz);
    grid.clearance.assign(n, 255);
    grid.surface.assign(n, 0);
    for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x)
                if (solid(x, y, z))
                    grid.clearance[index(x, y, z)] = 0, grid.surface[index(x, y, z)] = surface(x, y, z);
    for (int distance = 0; distance < 254; ++distance)
        for (int z = 0; z < nz; ++z)
            for (int y = 0; y < ny; ++y)
                for (int x = 0; x < nx; ++x)
                {
                    if (grid.clearance[index(x, y, z)] != distance) continue;
                    for (int c = std::max(z - 1, 0); c <= std::min(z + 1, nz - 1); ++c)
                        for (int b = std::max(y - 1, 0); b <= std::min(y + 1, ny - 1); ++b)
                            for (int a = std::max(x - 1, 0); a <= std::min(x + 1, nx - 1); ++a)
                                grid.clearance[index(a, b, c)] = std::min(
                                    grid.clearance[index(a, b, c)], static_cast<std::uint8_t>(distance + 1));
                }
    return grid;
}

Wind grid_wind(int nx, int ny, int nz, Vec3f origin_m, Vec3f cell_m,
               const std::function<WindCell(float, float, float)>& cell)
{
    Wind wind;
    wind.kind = WindKind::grid;
    wind.turbulent = true;
    wind.nx = nx, wind.ny = ny, wind.nz = nz;
    wind.origin_m = origin_m, wind.cell_m = cell_m;
    const auto at = [](float origin, float step, int i) { return origin + step * static_cast<float>(i); };
    for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x)
                wind.cells.push_back(cell(at(origin_m.x, cell_m.x, x), at(origin_m.y, cell_m.y, y),
                                          at(origin_m.z, cell_m.z, z)));
    return wind;
}

WindCell isotropic(float sigma, float rate)
{
    WindCell c{};
    c.s11 = c.s22 = c.s33 = sigma;
    c.c0_eps = 2 * sigma * sigma * rate;
    return c;
}

namespace
{

WindCell gusty(float x, float y, float z)
{
    const float wave = std::sin(0.4F * x) * std::cos(0.3F * y);
    WindCell c{};
    c.u = 4 + wave, c.v = 1.5F * std::sin(0.2F * x), c.w = 0.3F * std::cos(0.5F * z);
    c.gradient = 0.8F + 3.0F * std::abs(wave);
    c.s11 = 1.2F + 0.3F * wave, c.s21 = 0.2F, c.s22 = 0.9F, c.s31 = -0.3F, c.s32 = 0.1F,
    c.s33 = 0.6F + 0.02F * z;
    c.div_s1 = 0.12F * std::cos(0.4F * x), c.div_s2 = 0.01F, c.div_s3 = 0.02F;
    c.c0_eps = 2.0F / (0.5F + z);
    return c;
}

void add_emitters(World& w)
{
    Emitter e;
    e.a = {5, 15, 10};
    e.rate_per_s = 333.3;
    w.emitters.push_back(e);  // point, at rest in the air

    e.shape = EmitterShape::line;
    e.a = {2, 2, 15}, e.b = {2, 28, 18};
    e.at_rest_in_air = false;
    e.velocity_m_s = {0, 0, 5};
    w.emitters.push_back(e);

    e.shape = EmitterShape::sphere_surface;
    e.a = {20, 20, 12}, e.radius_m = 2;
    e.velocity_m_s = {0, 0, 0};
    e.burst = 500;
    w.emitters.push_back(e);

    e.shape = EmitterShape::sphere_volume;
    e.at_rest_in_air = true;
    w.emitters.push_back(e);

    e.shape = EmitterShape::plane;
    e.a = {0, 0, 19}, e.b = {40, 0, 19}, e.c = {0, 30, 19};
    e.rate_per_s = 2000;
    w.emitters.push_back(e);

    e.shape = EmitterShape::box;
    e.a = {0, 0, 0}, e.b = {40, 30, 20};  // solids and ground included
    e.burst = 3000;
    w.emitters.push_back(e);

    e.shape = EmitterShape::sky;
    e.a = {20, 15, 8}, e.b = {12, 12, 12};
    e.burst = 1500;
    e.anchor = 0;
    w.emitters.push_back(e);
}

}  // namespace

World world_with_everything(std::uint64_t capacity, OnLeave on_leave, bool turbulent)
{
    World w;
    w.size_m = {40, 30, 20};
    w.on_leave = on_leave;
    w.step_s = 1.0 / 30;
    w.seed = 20101;
    w.capacity = capacity;
    w.wind = grid_wind(9, 7, 5, {2, 2, 1}, {4.5F, 4.3F, 4.5F}, gusty);
    w.wind.turbulent = turbulent;
    w.ground_m = 0.5F;
    w.ground = {Contact::bounce, 0.4F};
    w.surfaces = {{Contact::land, 0}, {Contact::bounce, 0.7F}, {Contact::vanish, 0}, {Contact::bounce, 1.0F}};
    const auto solid = [](int x, int y, int z)
    {
        const bool tower = x >= 12 && x < 16 && y >= 10 && y < 20 && z < 12;
        const bool house = x >= 26 && x < 34 && y >= 5 && y < 25 && z < 7;
        const bool fence = x == 22 && z < 5;
        const bool lid = x >= 5 && x < 9 && y >= 3 && y < 27 && z == 8;
        return tower || house || fence || lid;
    };
    w.voxels =
        voxels(40, 30, 20, 1, solid, [](int x, int, int) { return static_cast<std::uint8_t>(x / 10); });
    w.anchors = {{{{0.0, {20, 15, 8}}, {1.0, {24, 15, 8}}, {2.5, {10, 18, 9}}}}};
    add_emitters(w);
    return w;
}

TestRun::TestRun(const World& world, CpuOptions options)
    : memory(world.capacity),
      flakes(memory.flakes()),
      backend(make_cpu_backend(world, flakes, memory.draw_list(), options))
{
}

void TestRun::steps(int n)
{
    for (int i = 0; i < n; ++i) backend->step();
}

std::uint64_t recount_alive(const TestRun& run)
{
    std::uint64_t n = 0;
    for (std::size_t i = 0; i < run.backend->slots_used(); ++i)
        n += (run.flakes.state[i] & 0xFFU) == 0 ? 1 : 0;
    return n;
}

std::uint64_t misplaced(const World& world, const TestRun& run)
{
    const VoxelGrid& v = world.voxels;
    std::uint64_t n = 0;
    for (std::size_t i = 0; i < run.backend->slots_used(); ++i)
    {
        if ((run.flakes.state[i] & 0xFFU) != 0) continue;
        const float p[3] = {run.flakes.x[i], run.flakes.y[i], run.flakes.z[i]};
        bool bad = !std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]);
        bad = bad || (world.has_ground && p[2] < world.ground_m);
        if (!bad && v.nx > 0)
        {
            const auto cell = [&](int axis, float origin)
            { return static_cast<int>(std::floor((p[axis] - origin) / v.cell_m)); };
            const int x = cell(0, v.origin_m.x);
            const int y = cell(1, v.origin_m.y);
            const int z = cell(2, v.origin_m.z);
            const bool inside = x >= 0 && y >= 0 && z >= 0 && x < v.nx && y < v.ny && z < v.nz;
            bad = inside && v.clearance[static_cast<std::size_t>((z * v.ny + y) * v.nx + x)] == 0;
        }
        n += bad ? 1 : 0;
    }
    return n;
}

}  // namespace spindrift::cpu::test
