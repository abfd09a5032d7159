// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/flake_words.h"
#include "core/number.h"
#include "core/philox.h"
#include "core/platform.h"

namespace spindrift
{

/// All bits of one flake, mixed. The hash of a run is the sum of these modulo 2^64, so that it depends
/// neither on the order nor on the slots of the flakes.
SPINDRIFT_HD std::uint64_t flake_hash(const std::uint32_t (&bits)[11])
{
    std::uint64_t h = 0x9E3779B97F4A7C15U;  // mix64 keeps 0
    for (int i = 0; i + 1 < 11; i += 2)
        h = mix64(h ^ (static_cast<std::uint64_t>(bits[i + 1]) << 32 | bits[i]));
    return mix64(h ^ bits[10]);
}

/// Of the flake in a slot; 0 if it does not live.
SPINDRIFT_HD std::uint64_t flake_hash(const FlakeView& f, std::size_t i)
{
    if (!is_alive(f.state[i])) return 0;
    return flake_hash({bits(f.x[i]), bits(f.y[i]), bits(f.z[i]), bits(f.q1[i]), bits(f.q2[i]), bits(f.q3[i]),
                       bits(f.slip_x[i]), bits(f.slip_y[i]), bits(f.slip_z[i]), f.id[i], f.state[i]});
}

/// The counts of a run, mixed; added to the sum over the flakes.
SPINDRIFT_HD std::uint64_t counts_hash(const FlakeCounts& c)
{
    std::uint64_t h = mix64(c.emitted ^ 0x9E3779B97F4A7C15U);
    h = mix64(h ^ c.alive);
    h = mix64(h ^ c.left);
    h = mix64(h ^ c.landed);
    h = mix64(h ^ c.vanished);
    return mix64(h ^ c.withheld);
}

}  // namespace spindrift
