// SPDX-License-Identifier: MIT
#pragma once

#include "validation/check.h"

namespace spindrift::validation
{

// What the cases run, one file a topic.

Outcome validate_ornstein_uhlenbeck(const Settings& settings);
Outcome validate_taylor(const Settings& settings);
Outcome validate_gaussian_plume(const Settings& settings);
Outcome validate_power_law_plume(const Settings& settings);
Outcome validate_sinusoid(const Settings& settings);
Outcome validate_channel(const Settings& settings);
Outcome validate_surface_layer(const Settings& settings);
Outcome validate_rouse(const Settings& settings);
Outcome validate_settling(const Settings& settings);
Outcome validate_uniform_wind(const Settings& settings);
Outcome validate_solver_order(const Settings& settings);
Outcome validate_prairie_grass(const Settings& settings);

}  // namespace spindrift::validation
