// SPDX-License-Identifier: MIT
#include "cpu/held_world.h"

#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <sys/mman.h>

#include "core/error.h"
#include "core/gradient_reach.h"
#include "cpu/huge_pages.h"

namespace spindrift::cpu
{

namespace
{

/// What packs may read behind the clearances (Voxels::clearance).
constexpr std::size_t kGatherOverrun = 3;

/// Copies all but the wind cells, which may be large.
World without_cells(const World& world)
{
    World w;
    w.size_m = world.size_m, w.on_leave = world.on_leave, w.step_s = world.step_s, w.seed = world.seed;
    w.capacity = world.capacity, w.snow = world.snow, w.emitters = world.emitters;
    w.has_ground = world.has_ground, w.ground_m = world.ground_m, w.ground = world.ground;
    w.voxels = world.voxels, w.surfaces = world.surfaces, w.anchors = world.anchors;
    const Wind& from = world.wind;
    w.wind.kind = from.kind, w.wind.turbulent = from.turbulent, w.wind.uniform_m_s = from.uniform_m_s;
    w.wind.friction_velocity_m_s = from.friction_velocity_m_s, w.wind.roughness_m = from.roughness_m;
    w.wind.ground_m = from.ground_m, w.wind.boundary_layer_m = from.boundary_layer_m;
    w.wind.to_x = from.to_x, w.wind.to_y = from.to_y;
    w.wind.nx = from.nx, w.wind.ny = from.ny, w.wind.nz = from.nz;
    w.wind.origin_m = from.origin_m, w.wind.cell_m = from.cell_m;
    return w;
}

std::size_t cells_of(int nx, int ny, int nz, const char* grid)
{
    const auto n = [](int i) { return static_cast<double>(i); };
    if (nx < 1 || ny < 1 || nz < 1 || n(nx) * n(ny) * n(nz) > 2147483647.0)
        throw Error(fmt::format(
            "{} has {} x {} x {} cells; use at least 1 along each axis and fewer than 2^31 in all", grid, nx,
            ny, nz));
    return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz);
}

void check_wind(const Wind& wind)
{
    if (wind.kind != WindKind::grid) return;
    if (cells_of(wind.nx, wind.ny, wind.nz, "the wind grid") != wind.cells.size())
        throw Error(fmt::format("the wind grid of {} x {} x {} cells holds {} of them", wind.nx, wind.ny,
                                wind.nz, wind.cells.size()));
    if (!(wind.cell_m.x > 0 && wind.cell_m.y > 0 && wind.cell_m.z > 0))
        throw Error("the wind grid has cells without size; they need more than 0 m along each axis");
}

void check_voxels(const World& world)
{
    const VoxelGrid& v = world.voxels;
    if (v.nx == 0) return;
    const std::size_t cells = cells_of(v.nx, v.ny, v.nz, "the voxel grid");
    if (v.clearance.size() != cells || v.surface.size() != cells)
        throw Error(fmt::format("the voxel grid of {} cells has {} clearances and {} surfaces", cells,
                                v.clearance.size(), v.surface.size()));
    for (std::size_t i = 0; i < cells; ++i)
        if (v.clearance[i] == 0 && v.surface[i] >= world.surfaces.size())
            throw Error(
                fmt::format("voxel {} names surface {} of {}", i, v.surface[i], world.surfaces.size()));
}

}  // namespace

void check_world(const World& world)
{
    if (world.emitters.size() > 255)
        throw Error(fmt::format("{} emitters (their number is kept in a byte); use at most 255",
                                world.emitters.size()));
    if (world.capacity >= std::uint64_t{1} << 32)
        throw Error(fmt::format("capacity of {} flakes (slots are counted in 32 bits); use fewer than 2^32",
                                world.capacity));
    if (!(world.step_s > 0) || !std::isfinite(world.step_s))
        throw Error(fmt::format("step of {} s; use more than 0", world.step_s));
    for (const Emitter& e : world.emitters)
        if (e.anchor >= 0 && (static_cast<std::size_t>(e.anchor) >= world.anchors.size() ||
                              world.anchors[static_cast<std::size_t>(e.anchor)].keys.empty()))
            throw Error(
                fmt::format("an emitter follows anchor {}, which does not exist or has no keys", e.anchor));
    check_wind(world.wind);
    check_voxels(world);
}

void HeldWorld::Unmap::operator()(void* p) const
{
    munmap(p, bytes);
}

HeldWorld::HeldWorld(const World& world) : data_(without_cells(world))
{
    data_.voxels.clearance.resize(data_.voxels.clearance.size() + kGatherOverrun);
    const std::size_t bytes = world.wind.cells.size() * sizeof(WindCell);
    if (bytes == 0) return;
    void* p = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (p == MAP_FAILED)
        throw Error(fmt::format("no memory for a wind grid of {} MB; use a coarser one", bytes >> 20));
    cells_ = std::unique_ptr<void, Unmap>(p, Unmap{bytes});
    ask_for_huge_pages(p, bytes);
    std::memcpy(p, world.wind.cells.data(), bytes);
    const Wind& wind = world.wind;
    if (wind.turbulent)
        spread_gradients(static_cast<WindCell*>(p), wind.nx, wind.ny, wind.nz, wind.cell_m, world.step_s);
}

AdvectJob HeldWorld::job() const
{
    const Wind& wind = data_.wind;
    AdvectJob job;
    job.step.dt_s = static_cast<float>(data_.step_s);
    job.step.seed = data_.seed;
    job.wind_kind = wind.kind;
    job.turbulent = wind.turbulent;
    const SurfaceLayer layer = surface_layer(wind);
    job.uniform = {wind.uniform_m_s, layer};
    job.logarithmic = {layer, wind.to_x, wind.to_y};
    if (wind.kind == WindKind::grid) job.grid = grid_wind(wind, static_cast<const WindCell*>(cells_.get()));
    job.fall_speed = FallSpeed(data_.snow, data_.seed);
    job.around.on_leave = data_.on_leave;
    job.around.solids = solids_view(data_);
    job.around.one_region = true;
    for (const Emitter& e : data_.emitters)
        if (e.shape == EmitterShape::sky && data_.emitters.size() > 1) job.around.one_region = false;
    return job;
}

}  // namespace spindrift::cpu
