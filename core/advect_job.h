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

/// The job of any step, but for its number, flakes and regions. `cells` and the addresses in `solids` are
/// those of the memory that the job will run in; the cells' gradients are spread (core/gradient_reach.h).
inline AdvectJob advect_job(const World& world, const WindCell* cells, const Solids& solids)
{
    const Wind& wind = world.wind;
    AdvectJob job;
    job.step.dt_s = static_cast<float>(world.step_s);
    job.step.seed = world.seed;
    job.wind_kind = wind.kind;
    job.turbulent = wind.turbulent;
    const SurfaceLayer layer = surface_layer(wind);
    job.uniform = {wind.uniform_m_s, layer};
    job.logarithmic = {layer, wind.to_x, wind.to_y};
    if (wind.kind == WindKind::grid) job.grid = grid_wind(wind, cells);
    job.fall_speed = FallSpeed(world.snow, world.seed);
    job.around.on_leave = world.on_leave;
    job.around.solids = solids;
    job.around.one_region = true;
    for (const Emitter& e : world.emitters)
        if (e.shape == EmitterShape::sky && world.emitters.size() > 1) job.around.one_region = false;
    return job;
}

}  // namespace spindrift
