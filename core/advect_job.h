// SPDX-License-Identifier: MIT
#pragma once

#include "core/advect.h"
#include "core/encounter.h"
#include "core/flake.h"
#include "core/snow.h"
#include "core/wind.h"
#include "core/world.h"

namespace spindrift
{

/// Everything that one step of one World needs to know, the same for all flakes. Plain numbers and addresses.
struct AdvectJob
{
    StepParams step;
    WindKind wind_kind = WindKind::uniform;
    bool turbulent = false;
    UniformWind uniform;
    LogWind logarithmic;
    GridWind grid;
    FallSpeed fall_speed;
    Surroundings around;
    FlakeView flakes{};
};

/// The job of any step, but for its number, flakes, regions, StepParams::near_walls and ::relaxations.
/// `cells` and the addresses in `solids` are those of the memory that the job will run in; the cells'
/// gradients are spread (core/gradient_reach.h).
inline AdvectJob advect_job(const World& world, const WindCell* cells, const Solids& solids)
{
    const Wind& wind = world.wind;
    AdvectJob job;
    job.step.dt_s = static_cast<float>(world.step_s);
    job.step.seed = world.seed;
    job.step.inertial = world.snow.inertia;
    job.step.crossing_squared = world.snow.crossing * world.snow.crossing;
    job.step.fine =
        is_fine(world.step_s, static_cast<double>(max(max(world.size_m.x, world.size_m.y), world.size_m.z)));
    job.wind_kind = wind.kind;
    job.turbulent = wind.turbulent;
    const SurfaceLayer layer = surface_layer(wind);
    job.uniform = {wind.uniform_m_s, layer};
    job.logarithmic = {layer, wind.to_x, wind.to_y};
    if (wind.kind == WindKind::grid) job.grid = grid_wind(wind, cells);
    job.fall_speed = FallSpeed(world.snow, world.seed);
    job.fall_speed.grains = GrainSpeed(world.grains);
    for (std::size_t e = world.emitters.size(); e > 0 && world.emitters[e - 1].shape == EmitterShape::drift;
         --e)
        job.fall_speed.first_drift = static_cast<std::int32_t>(e - 1);
    job.around.on_leave = world.on_leave;
    job.around.solids = solids;
    job.around.one_region = true;
    for (const Emitter& e : world.emitters)
        if (e.shape == EmitterShape::sky && world.emitters.size() > 1) job.around.one_region = false;
    return job;
}

}  // namespace spindrift
