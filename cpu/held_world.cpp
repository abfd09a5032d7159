// SPDX-License-Identifier: MIT
#include "cpu/held_world.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>
#include <sys/mman.h>

#include "core/error.h"
#include "core/gradient_reach.h"
#include "cpu/huge_pages.h"
#include "cpu/parallel.h"

namespace spindrift::cpu
{

namespace
{

/// What packs may read behind the clearances (Voxels::clearance).
constexpr std::size_t kGatherOverrun = 3;

/// Wind cells, or columns of them, that one thread works on in a row: 256 KB.
constexpr std::size_t kTogether = 4096;

template <class Body>
void for_parts(std::size_t n, const Body& body)
{
    parallel_for_each_index((n + kTogether - 1) / kTogether,
                            [&](std::size_t part)
                            {
                                const std::size_t last = std::min((part + 1) * kTogether, n);
                                for (std::size_t i = part * kTogether; i < last; ++i) body(i);
                            });
}

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
    w.wind.gusts = from.gusts, w.wind.gust_share = from.gust_share, w.wind.bodies = from.bodies;
    return w;
}

}  // namespace

void HeldWorld::Unmap::operator()(void* p) const
{
    munmap(p, bytes);
}

HeldWorld::HeldWorld(const World& world)
    : data_(without_cells(world)), relaxations_(relaxations(world)), near_walls_(steps_reach_walls(world))
{
    data_.voxels.clearance.resize(data_.voxels.clearance.size() + kGatherOverrun);
    const std::size_t bytes = world.wind.cells.size() * sizeof(WindCell);
    if (bytes == 0) return;
    void* p = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (p == MAP_FAILED)
        throw Error(fmt::format("no memory for a wind grid of {} MB; use a coarser one", bytes >> 20));
    cells_ = std::unique_ptr<void, Unmap>(p, Unmap{bytes});
    ask_for_huge_pages(p, bytes);
    const Wind& wind = world.wind;
    if (wind.changes())
    {
        states_ = spread_states(world, times_s_);
        std::memcpy(p, states_.data(), bytes);
        prepare_to_blow();
        return;
    }
    std::memcpy(p, wind.cells.data(), bytes);
    if (wind.turbulent)
        spread_gradients(static_cast<WindCell*>(p), wind.nx, wind.ny, wind.nz, wind.cell_m,
                         world.step_s / relaxations_);
}

void HeldWorld::prepare_to_blow()
{
    const Wind& wind = data_.wind;
    blown_ = blown_wind(wind, data_.step_s);
    blown_.states = {states_.data(), times_s_.data(), times_s_.size(), states_.size() / times_s_.size(),
                     static_cast<WindCell*>(cells_.get())};
    blown_.gust_share = wind.gust_share.data();
    if (wind.gusts.speed_m_s > 0)
    {
        stream_.resize((static_cast<std::size_t>(wind.nx) + 2) * (static_cast<std::size_t>(wind.ny) + 2));
        blown_.stream_m2_s = stream_.data();
    }
    for (const Body& body : wind.bodies)
        bodies_.push_back(
            {{body.path.keys.data(), static_cast<std::uint32_t>(body.path.keys.size()), false, {}},
             body.size_m});
    moving_.resize(bodies_.size());
    blown_.bodies = bodies_.data();
    blown_.moving = moving_.data();
}

void HeldWorld::blow(std::uint64_t step)
{
    if (states_.empty()) return;
    blown_.place_bodies(step);
    for_parts(blown_.stream_points(), [&](std::size_t i) { blown_.stream(step, i); });
    const WindMoment moment = moment_of(blown_.states, blown_.time_of(step));
    for_parts(blown_.states.cells, [&](std::size_t i) { blown_.cell(moment, i); });
}

AdvectJob HeldWorld::job() const
{
    AdvectJob job = advect_job(data_, static_cast<const WindCell*>(cells_.get()), solids_view(data_));
    job.step.relaxations = relaxations_;
    job.step.near_walls = near_walls_;
    return job;
}

}  // namespace spindrift::cpu
