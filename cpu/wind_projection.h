// SPDX-License-Identifier: MIT
#pragma once

#include "core/staggered_wind.h"
#include "cpu/poisson_solver.h"

namespace spindrift::cpu
{

/// How a projection is solved; `largest_residual` is set by the projection.
struct ProjectionSettings
{
    PoissonSettings solver;
    int threads = 0;  ///< 0: those of the current arena
};

/// A WindProjector (core/staggered_wind.h), in double, by multigrid unless `settings` say otherwise.
Projection make_divergence_free(StaggeredWind& wind, const ProjectionSettings& settings = {});

/// make_divergence_free with its usual settings, for those who take a WindProjector.
inline WindProjector project_wind()
{
    return [](StaggeredWind& wind) { return make_divergence_free(wind); };
}

}  // namespace spindrift::cpu
