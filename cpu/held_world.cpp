// SPDX-License-Identifier: MIT
#include "cpu/held_world.h"

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
    w.capacity = world.capacity, w.snow = world.snow, w.emitters = world.emitters, w.grains = world.grains;
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

}  // namespace

void HeldWorld::Unmap::operator()(void* p) const
{
    munmap(p, bytes);
}

HeldWorld::HeldWorld(const World& world) : data_(without_cells(world)), near_walls_(steps_reach_walls(world))
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
    AdvectJob job = advect_job(data_, static_cast<const WindCell*>(cells_.get()), solids_view(data_));
    job.step.near_walls = near_walls_;
    return job;
}

}  // namespace spindrift::cpu
