// SPDX-License-Identifier: MIT
#include "validation/all_cases.h"

namespace spindrift::validation
{

const std::vector<Case>& cases()
{
    static const std::vector<Case> all = {
        {"ornstein-uhlenbeck",
         "moments and diffusivity over a = dt / T from 1e-3 to 1e3",
         4000,
         {},
         validate_ornstein_uhlenbeck},
        {"taylor",
         "spread from a point in homogeneous turbulence (Taylor 1921)",
         30000,
         {0.02},
         validate_taylor},
        {"gaussian-plume",
         "plume over a reflecting ground, open and under a lid",
         100000,
         {0.02},
         validate_gaussian_plume},
        {"power-law-plume",
         "wind and diffusivity that grow as powers of height",
         50000,
         {0.02},
         validate_power_law_plume},
        {"sinusoid",
         "well mixed in a sinusoidal variance",
         50000,
         {0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 1, 4},
         validate_sinusoid},
        {"channel",
         "well mixed between two walls with shear stress",
         50000,
         {0.01, 0.05, 0.1, 0.4, 1, 4},
         validate_channel},
        {"surface-layer",
         "well mixed in the neutral surface layer",
         50000,
         {0.01, 0.05, 0.1, 0.4, 1, 4},
         validate_surface_layer},
        {"rouse", "settling against turbulence between closed walls", 5000, {0.01}, validate_rouse},
        {"settling",
         "falls and throws in still air against linear drag",
         200,
         {0.001, 0.02, 0.5},
         validate_settling},
        {"uniform-wind",
         "even seeding stays even in the solved wind of town",
         200000,
         {0.02},
         validate_uniform_wind},
        {"solver-order",
         "convergence of the wind's solver on a manufactured field",
         0,
         {},
         validate_solver_order},
        {"prairie-grass",
         "crosswind-integrated concentrations of field releases at 50, 100 and 200 m",
         20000,
         {0.05},
         validate_prairie_grass},
    };
    return all;
}

}  // namespace spindrift::validation
