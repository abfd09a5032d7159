// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/math.h"

namespace spindrift
{

/// Four 32-bit words per lane. UInt is uint32_t or a pack of it.
template <class UInt>
struct Philox4
{
    UInt x0, x1, x2, x3;
};

/// Philox4x32-10: a bijection of the counter for each key, random to every known test. No state: whoever asks
/// for (key, counter) gets the same words, on any machine, in any order. Source: Salmon, Moraes, Dror, Shaw,
/// "Parallel random numbers: as easy as 1, 2, 3", SC 2011.
template <class UInt>
SPINDRIFT_HD Philox4<UInt> philox(std::uint64_t key, Philox4<UInt> counter)
{
    auto key0 = static_cast<std::uint32_t>(key);
    auto key1 = static_cast<std::uint32_t>(key >> 32);
    Philox4<UInt> c = counter;
    for (int round_number = 0; round_number < 10; ++round_number)
    {
        UInt high0, low0, high2, low2;
        multiply_wide(UInt(0xD2511F53U), c.x0, high0, low0);
        multiply_wide(UInt(0xCD9E8D57U), c.x2, high2, low2);
        c = {high2 ^ c.x1 ^ UInt(key0), low2, high0 ^ c.x3 ^ UInt(key1), low0};
        key0 += 0x9E3779B9U;  // golden ratio
        key1 += 0xBB67AE85U;  // sqrt(3) - 1
    }
    return c;
}

/// What a random number is for: the third word of the counter. Numbers of different streams are independent.
enum class RandomStream : std::uint32_t
{
    turbulence = 0,
    emission = 1,
    turbulence_start = 2,
    respawn = 3,
    rounding = 4,
};

/// The words of flake `id` (any emission serial number modulo 2^32) in time step `step`; `substep` counts
/// draws within it.
template <class UInt>
SPINDRIFT_HD Philox4<UInt> random_words(std::uint64_t seed, UInt id, std::uint32_t step, RandomStream stream,
                                        std::uint32_t substep = 0)
{
    return philox<UInt>(seed, {id, UInt(step), UInt(static_cast<std::uint32_t>(stream)), UInt(substep)});
}

/// Uniform in (0, 1): the middle of one of 2^23 equal intervals, exact in float.
template <class R>
SPINDRIFT_HD R uniform(UIntOf<R> word)
{
    return (to_real<R>(as_int(word >> 9)) + number<R>(0.5)) * number<R>(0x1p-23);
}

/// Standard normal, independent of each other; |value| < 5.8.
template <class R>
struct Gaussians
{
    R x, y, z, w;
};

/// Box-Muller on the two halves of random_words.
template <class R>
SPINDRIFT_HD Gaussians<R> gaussians(const Philox4<UIntOf<R>>& words)
{
    const R minus_two_ln2 = number<R>(-1.38629436111989061883);
    const R radius0 = sqrt(minus_two_ln2 * log2(uniform<R>(words.x0)));
    const R radius1 = sqrt(minus_two_ln2 * log2(uniform<R>(words.x2)));
    R sine0, cosine0, sine1, cosine1;
    sincos_turns(uniform<R>(words.x1), sine0, cosine0);
    sincos_turns(uniform<R>(words.x3), sine1, cosine1);
    return {radius0 * cosine0, radius0 * sine0, radius1 * cosine1, radius1 * sine1};
}

template <class R>
SPINDRIFT_HD Gaussians<R> gaussians(std::uint64_t seed, UIntOf<R> id, std::uint32_t step, RandomStream stream,
                                    std::uint32_t substep = 0)
{
    return gaussians<R>(random_words(seed, id, step, stream, substep));
}

/// Mixes 32 bits, a bijection: MurmurHash3's fmix32 (Appleby, public domain). The shaders hold the same.
template <class UInt>
SPINDRIFT_HD UInt mix32(UInt h)
{
    h = h ^ (h >> 16);
    h = h * UInt(0x85EBCA6BU);
    h = h ^ (h >> 13);
    h = h * UInt(0xC2B2AE35U);
    return h ^ (h >> 16);
}

/// Mixes 64 bits, a bijection: the finaliser of SplitMix64 (Steele, Lea, Flood 2014; variant 13 of Stafford).
/// For state hashes.
SPINDRIFT_HD std::uint64_t mix64(std::uint64_t h)
{
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9U;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBU;
    return h ^ (h >> 31);
}

}  // namespace spindrift
