// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "core/staggered_wind.h"
#include "cpu/poisson_solver.h"

namespace spindrift::cpu
{

/// How a projection is solved; `largest_residual` is set by the projection.
struct ProjectionSettings
{
    PoissonSettings solver;
    int threads = 0;                      ///< 0: those of the current arena
    PoissonSolverMaker make_solver = {};  ///< none: the processor's; else what runs on another backend
};

/// A WindProjector (core/staggered_wind.h), in double, by multigrid unless `settings` say otherwise. The bits
/// are the same whatever solves.
Projection make_divergence_free(StaggeredWind& wind, const ProjectionSettings& settings = {});

/// make_divergence_free with its usual settings, for those who take a WindProjector.
inline WindProjector project_wind(PoissonSolverMaker make_solver = {})
{
    return [settings = ProjectionSettings{{}, 0, std::move(make_solver)}](StaggeredWind& wind)
    { return make_divergence_free(wind, settings); };
}

}  // namespace spindrift::cpu
