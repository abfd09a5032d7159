// SPDX-License-Identifier: MIT
#include "cpu/snapshot.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "core/error.h"
#include "core/state_hash.h"

namespace spindrift::cpu
{

namespace
{

constexpr std::size_t kArrays = 11;
constexpr std::size_t kFloats = 9;
constexpr std::size_t kState = 10;

std::array<void*, kArrays> arrays_of(const FlakeView& f)
{
    return {f.x, f.y, f.z, f.q1, f.q2, f.q3, f.slip_x, f.slip_y, f.slip_z, f.id, f.state};
}

bool is_alive(std::uint32_t state)
{
    return (state & 0xFFU) == 0;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> alive_arrays(const FlakeView& flakes, std::size_t used)
{
    std::vector<std::vector<std::uint32_t>> result;
    for (const void* array : arrays_of(flakes))
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

void check_arrays(const Snapshot& s, std::uint64_t capacity, std::size_t emitters)
{
    const FlakeCounts& c = s.counts;
    if (c.alive > capacity)
        throw Error(fmt::format("snapshot holds {} flakes, more than the capacity of {}; raise the capacity",
                                c.alive, capacity));
    bool whole = s.arrays.size() == kArrays && c.emitted == c.alive + c.left + c.landed + c.vanished;
    for (const auto& array : s.arrays) whole = whole && array.size() == c.alive;
    for (std::size_t a = 0; whole && a < kFloats; ++a)
        for (const std::uint32_t word : s.arrays[a])
            whole = whole && std::isfinite(std::bit_cast<float>(word));
    if (whole)
        for (const std::uint32_t state : s.arrays[kState])
            whole = whole && is_alive(state) && state >> 8 < emitters;
    if (!whole) throw Error("snapshot contradicts itself (damaged); write it again");
}

void put_arrays(const Snapshot& s, const FlakeView& flakes)
{
    const std::array<void*, kArrays> arrays = arrays_of(flakes);
    for (std::size_t a = 0; a < kArrays; ++a)
        if (!s.arrays[a].empty()) std::memcpy(arrays[a], s.arrays[a].data(), 4 * s.arrays[a].size());
}

std::uint64_t flakes_hash(const FlakeView& flakes, std::size_t first, std::size_t last)
{
    const std::array<void*, kArrays> arrays = arrays_of(flakes);
    std::uint64_t sum = 0;
    for (std::size_t i = first; i < last; ++i)
    {
        if (!is_alive(flakes.state[i])) continue;
        std::uint32_t bits[kArrays];
        for (std::size_t a = 0; a < kArrays; ++a)
            std::memcpy(&bits[a], static_cast<const unsigned char*>(arrays[a]) + 4 * i, 4);
        sum += flake_hash(bits);
    }
    return sum;
}

}  // namespace spindrift::cpu
