// SPDX-License-Identifier: MIT
#pragma once

#include "core/math.h"

namespace spindrift
{

// Automatic exposure: the log-average of the picture is shown as a middle grey. shaders/meter.frag and
// shaders/expose.frag mirror this. Source: Reinhard et al., SIGGRAPH 2002, eq. 1 and 2.

/// Added to each luminance before the logarithm, so that black pixels count as dark and not as -inf.
inline constexpr double kDarkest = 1e-4;

/// What one pixel gives to the mean; y is not negative.
template <class R>
SPINDRIFT_HD R log_luminance(R y)
{
    return log2(y + number<R>(kDarkest));
}

/// log2 of the exposure that shows a picture of that mean log2 luminance as `grey`.
template <class R>
SPINDRIFT_HD R wanted_log_exposure(R mean_log_luminance, R grey)
{
    return log2(grey) - mean_log_luminance;
}

/// The share of the way to the wanted exposure that passes in dt_s: the same path for any rate of frames.
/// time_s: in which all but 1/e of a difference is gone; 0: at once.
template <class R>
SPINDRIFT_HD R adapted_share(R dt_s, R time_s)
{
    if (!(time_s > number<R>(0))) return number<R>(1);
    return number<R>(1) - exp(-dt_s / time_s);
}

}  // namespace spindrift
