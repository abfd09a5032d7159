// SPDX-License-Identifier: MIT
#pragma once

namespace spindrift::validation
{

/// Mean square distance from the start after t = times · T in homogeneous turbulence, in units of (sigma
/// T)^2: 2 (t/T - 1 + e^(-t/T)) (Taylor 1921).
double taylor_spread(double times);

}  // namespace spindrift::validation
