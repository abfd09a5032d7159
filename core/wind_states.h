// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/number.h"
#include "core/platform.h"
#include "core/world.h"

namespace spindrift
{

/// The states of a wind that changes with time (Wind::later behind Wind::cells), each `cells` long, and the
/// memory that the flakes' wind is mixed into. Plain addresses.
struct WindStates
{
    const WindCell* states = nullptr;  ///< one behind the other
    const double* times_s = nullptr;   ///< ascending from 0
    std::size_t count = 0;
    std::size_t cells = 0;
    WindCell* now = nullptr;
};

/// Between which states a time lies.
struct WindMoment
{
    std::size_t before = 0;
    float share = 0;  ///< of the state after it, 0 to 1

    bool operator==(const WindMoment&) const = default;
};

/// Before the first state and after the last these hold.
SPINDRIFT_HD WindMoment moment_of(const WindStates& winds, double time_s)
{
    if (winds.count < 2) return {0, 0};
    std::size_t before = 0;
    while (before + 2 < winds.count && winds.times_s[before + 1] <= time_s) ++before;
    const double from = winds.times_s[before], to = winds.times_s[before + 1];
    const double share = (time_s - from) / (to - from);
    return {before, static_cast<float>(share < 0 ? 0.0 : share > 1 ? 1.0 : share)};
}

/// Mixes the records of cell i linearly. S is linear in that, and div_s is the divergence of the mixed S, as
/// the whitened model needs; the mean wind stays free of divergence (docs/physics.md "Wind that changes").
SPINDRIFT_HD void mix_cell(const WindStates& winds, const WindMoment& moment, std::size_t i)
{
    const WindCell* const before = winds.states + moment.before * winds.cells + i;
    const float* const a = &before->u;
    if (moment.share == 0)
        winds.now[i] = *before;
    else
    {
        const float* const b = &before[winds.cells].u;
        float* const out = &winds.now[i].u;
        for (int n = 0; n < 16; ++n) out[n] = fma(moment.share, b[n] - a[n], a[n]);
    }
}

}  // namespace spindrift
