// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "validation/worlds.h"

namespace spindrift::validation
{

inline constexpr int kMixedBins = 25;

/// How well mixed the flakes of a run are along one axis, bin by bin: places, variances of the whitened
/// velocity and the shear stress u'w'. Each beside what sampling alone does to it.
struct Mixing
{
    double flakes = 0;
    double entropy = 0;       ///< sum of p ln p, p = count / expected
    double chi_square = 0;    ///< of the counts, over its degrees of freedom: 1 by sampling
    double variance = 0;      ///< mean square of (var q - 1) over its noise, all components: 1 by sampling
    double shear = 0;         ///< mean square of (u'w' - truth) over its noise: 1 by sampling
    double density_rms = 0;   ///< root mean square of p - 1
    double variance_rms = 0;  ///< root mean square of var q - 1 along the axis
    double entropy_noise() const { return kMixedBins * (kMixedBins - 1) / (2 * flakes); }
    double entropy_sd() const;
    double variance_noise() const;  ///< that variance_rms has by sampling alone
};

/// `low_m`, `high_m`: the range of the bins.
Mixing mixing(const World& world, const FlakeRun& run, Along axis, double low_m, double high_m);

/// sigma^2 = 1.1 + sin 2 pi x, C0 eps = 4 sigma^3 (m, s), one period, wrapped: the case of QES-Plume.
World sinusoid_world(const Settings& settings, double dt);

}  // namespace spindrift::validation
