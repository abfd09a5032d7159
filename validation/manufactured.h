// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/poisson_levels.h"

namespace spindrift::validation
{

/// -div grad x = b on a box of 1 x 1.5 x 0.8 with x = sin(pi x) sin(pi y / 1.5) cos(pi z / 1.6): its slope is
/// 0 at the ground, its value 0 on the other borders. n x (n + 1) x (n - 1) cells; the highest layer is
/// exp(stretch) times as thick as the lowest.
struct Manufactured
{
    PoissonProblem problem;
    std::vector<double> b, truth;  ///< in the layout of box()

    Manufactured(int n, double stretch);
    PaddedBox box() const;
    /// Root mean square of x - truth, weighted with volume.
    double error(const std::vector<double>& x) const;
};

}  // namespace spindrift::validation
