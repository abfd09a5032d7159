// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/anchors.h"
#include "core/backend.h"
#include "core/error.h"
#include "core/flake_words.h"
#include "core/math.h"
#include "core/number.h"

namespace spindrift
{

/// The arrays of the slots [0, used) as bits, without holes: Snapshot::arrays. Host only, as all here.
inline std::vector<std::vector<std::uint32_t>> alive_arrays(const FlakeView& flakes, std::size_t used)
{
    std::vector<std::vector<std::uint32_t>> result;
    for (const void* array : flake_words(flakes))
    {
        std::vector<std::uint32_t>& words = result.emplace_back();
        for (std::size_t i = 0; i < used; ++i)
        {
            if (!is_alive(flakes.state[i])) continue;
            std::uint32_t word = 0;
            std::memcpy(&word, static_cast<const unsigned char*>(array) + 4 * i, 4);
            words.push_back(word);
        }
    }
    return result;
}

namespace detail
{

inline void check_arrays(const Snapshot& s, std::uint64_t capacity, std::size_t emitters)
{
    const FlakeCounts& c = s.counts;
    if (c.alive > capacity)
        throw Error("snapshot holds " + std::to_string(c.alive) + " flakes, more than the capacity of " +
                    std::to_string(capacity) + "; raise the capacity");
    bool whole = s.arrays.size() == kFlakeArrays && c.emitted == c.alive + c.left + c.landed + c.vanished;
    for (const auto& array : s.arrays) whole = whole && array.size() == c.alive;
    for (std::size_t a = 0; whole && a < kFlakeFloatArrays; ++a)
        for (const std::uint32_t word : s.arrays[a]) whole = whole && is_finite(from_bits(word));
    if (whole)
        for (const std::uint32_t state : s.arrays[kFlakeArrays - 1])
            whole = whole && is_alive(state) && state >> 8 < emitters;
    if (!whole) throw Error("snapshot contradicts itself (damaged); write it again");
}

}  // namespace detail

/// Throws Error unless a snapshot belongs to this World, its arrays are whole, fit the capacity, and hold
/// finite, living flakes of emitters that exist.
inline void check_snapshot(const Snapshot& s, std::uint64_t world_hash, std::uint64_t capacity,
                           std::size_t emitters, const Anchors& anchors)
{
    if (s.world_hash != world_hash)
        throw Error(
            "snapshot belongs to another scene (its world differs); restore it with the scene that it was "
            "saved from");
    if (s.emitter_state.size() != 2 * emitters + anchors.words())
        throw Error("snapshot has not the state of this scene's emitters (damaged); write it again");
    detail::check_arrays(s, capacity, emitters);
}

}  // namespace spindrift
