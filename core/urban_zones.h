// SPDX-License-Identifier: MIT
#pragma once

#include "core/math.h"
#include "core/number.h"
#include "core/platform.h"

namespace spindrift
{

// Where the wind near a block differs from the approaching wind, before the projection: Roeckle's zones
// (docs/physics.md "Zones"). Lengths in metres; speeds as shares of a wind that the caller names. R: double.

/// A block as the wind meets it: extents across and along the wind.
template <class R>
struct BlockSize
{
    R height, width, length;
};

/// x^p for x > 0.
template <class R>
SPINDRIFT_HD R power(const R& x, double p)
{
    return exp2(R(p) * log2(x));
}

/// Length L_r of the closed recirculation behind a block. Roeckle (1990) after Fackrell (1984).
template <class R>
SPINDRIFT_HD R cavity_length(const BlockSize<R>& b)
{
    const R slenderness = min(max(b.length / b.height, R(0.3)), R(3.0));
    const R aspect = min(b.width / b.height, R(10.0));
    return R(1.8) * b.height * aspect / (power(slenderness, 0.3) * (R(1.0) + R(0.24) * aspect));
}

/// Length of the zone before a block at its foot.
template <class R>
SPINDRIFT_HD R upwind_length(const BlockSize<R>& b)
{
    return R(1.5) * b.width / (R(1.0) + R(0.8) * b.width / b.height);
}

/// Share of a zone's length that is left at `across` (of the half width) and `up` (of the height).
template <class R>
SPINDRIFT_HD R ellipsoid(const R& across, const R& up)
{
    return sqrt(max((R(1.0) - across * across) * (R(1.0) - up * up), R(0.0)));
}

/// In the cavity, x behind the lee wall and d the cavity's length there; of the wind at roof height.
template <class R>
SPINDRIFT_HD R cavity_speed(const R& x, const R& d)
{
    const R left = R(1.0) - x / d;
    return -(left * left);
}

/// In the wake, d <= x <= 3 d; of the wind that would be there.
template <class R>
SPINDRIFT_HD R wake_speed(const R& x, const R& d)
{
    return R(1.0) - power(d / x, 1.5);
}

/// Scale of what separates at the front edges: R = B_s^(2/3) B_l^(1/3), the smaller and the larger of height
/// and width. Wilson (1979).
template <class R>
SPINDRIFT_HD R separation_scale(const BlockSize<R>& b)
{
    return power(min(b.height, b.width), 2.0 / 3) * power(max(b.height, b.width), 1.0 / 3);
}

inline constexpr double kSeparationLength = 0.9;  ///< of the scale, along roof and side walls
inline constexpr double kSeparationDepth = 0.22;  ///< of the scale, away from them
inline constexpr double kUpwindShare = 0.4;       ///< of the wind that is left in the upwind zone
inline constexpr double kUpwindHeight = 0.6;      ///< of the block that the upwind zone reaches
inline constexpr double kBackflow = 0.5;    ///< at the wall under a separated layer (docs/decisions/011)
inline constexpr double kWakeLength = 3.0;  ///< of the cavity

/// Depth of a separated layer at x behind the edge, as a share of the largest.
template <class R>
SPINDRIFT_HD R separation_depth(const R& x, const R& length)
{
    const R s = R(2.0) * x / length - R(1.0);
    return sqrt(max(R(1.0) - s * s, R(0.0)));
}

/// In a separated layer, linear from the backflow at the wall to 1 at its edge; of the approaching wind.
template <class R>
SPINDRIFT_HD R separated_speed(const R& share_of_depth)
{
    return (R(1.0) + R(kBackflow)) * share_of_depth - R(kBackflow);
}

template <class R>
struct CanyonSpeed
{
    R along, up;
};

/// Between two blocks closer than the first one's cavity, x behind its lee wall and s the gap; of the wind at
/// its roof. Roeckle (1990).
template <class R>
SPINDRIFT_HD CanyonSpeed<R> canyon_speed(const R& x, const R& s)
{
    const R share = R(2.0) * x / s;  // 0 at the lee wall, 2 at the other block
    return {-share * (R(2.0) - share), -abs(R(0.5) * (R(1.0) - share)) * (share - R(1.0))};
}

}  // namespace spindrift
