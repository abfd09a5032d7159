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

/// Largest |g| that Schlick's function takes: at 0.93813 its k reaches 1 and the function its pole.
inline constexpr double kLargestSchlickG = 0.93;

/// k of Schlick's phase function for a Henyey-Greenstein g. Blasi, Le Saec and Schlick, Computer Graphics
/// Forum 12 (1993).
template <class R>
SPINDRIFT_HD R schlick_k(const R& g)
{
    return g * (number<R>(1.55) - number<R>(0.55) * (g * g));
}

/// Schlick's phase function, 1/sr: a rational stand-in for Henyey-Greenstein, for |k| < 1. Integrates to 1;
/// its mean cosine and its values differ (docs/drawing.md has the table).
template <class R>
SPINDRIFT_HD R schlick(const R& k, const R& mu)
{
    const R one = number<R>(1);
    const R away = one - k * mu;
    return (one - k * k) / (number<R>(12.5663706143591729539) * (away * away));
}

enum class PhaseKind
{
    henyey_greenstein,
    double_lobe,  ///< two Henyey-Greenstein lobes
    schlick,
};

/// How flakes throw one lamp's light. R: float or double.
template <class R>
struct Phase
{
    PhaseKind kind = PhaseKind::henyey_greenstein;
    R g{0};           ///< of the (first) lobe
    R g_back{0};      ///< double_lobe: of the second
    R back_share{0};  ///< double_lobe: share of the light that the second takes, 0 to 1
};

/// The same with the sign of the angle turned round, as the report prints it (CTS 11-04: the dot product of
/// eye to particle and light to particle): what goes forward comes back.
template <class R>
SPINDRIFT_HD Phase<R> turned_round(const Phase<R>& phase)
{
    return {phase.kind, -phase.g, -phase.g_back, phase.back_share};
}

/// Light scattered per solid angle, 1/sr; mu as above.
template <class R>
SPINDRIFT_HD R scattered_share(const Phase<R>& phase, const R& mu)
{
    if (phase.kind == PhaseKind::schlick) return schlick(schlick_k(phase.g), mu);
    const R ahead = henyey_greenstein(phase.g, mu);
    if (phase.kind == PhaseKind::henyey_greenstein) return ahead;
    return ahead + phase.back_share * (henyey_greenstein(phase.g_back, mu) - ahead);
}

}  // namespace spindrift
