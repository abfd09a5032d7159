// SPDX-License-Identifier: MIT
#pragma once

#include "core/math.h"

namespace spindrift
{

/// Henyey-Greenstein phase function, 1/sr: share of the light scattered per solid angle. mu: cosine between
/// the direction that the light travels and the direction in which it goes on (1: straight on). g: mean of
/// mu, in (-1, 1). Integrates to 1 over the sphere. (1 - g²) / (4 pi (1 + g² - 2 g mu)^1.5), with 1 + g² - 2
/// g mu = (1 - |g|)² + 2 |g| (1 - sign(g) mu): a sum of two terms that are not negative, so nothing cancels
/// near |g| = 1. Source: Henyey and Greenstein, Astrophysical Journal 93 (1941), 70.
template <class R>
SPINDRIFT_HD R henyey_greenstein(const R& g, const R& mu)
{
    const R one = number<R>(1);
    const R size = abs(g);
    const R rest = one - size;
    const R along = select(g < number<R>(0), -mu, mu);
    const R d = rest * rest + (size + size) * (one - along);
    return rest * (one + size) / (number<R>(12.5663706143591729539) * (d * sqrt(d)));
}

}  // namespace spindrift
