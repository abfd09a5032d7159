// SPDX-License-Identifier: MIT
#include "cpu/snapshot.h"

#include <array>
#include <cstring>

#include "core/snapshot_check.h"

namespace spindrift::cpu
{

namespace
{

std::array<void*, kFlakeArrays> arrays_of(const FlakeView& f)
{
    return {f.x, f.y, f.z, f.q1, f.q2, f.q3, f.slip_x, f.slip_y, f.slip_z, f.id, f.state};
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

void put_arrays(const Snapshot& s, const FlakeView& flakes)
{
    const std::array<void*, kFlakeArrays> arrays = arrays_of(flakes);
    for (std::size_t a = 0; a < kFlakeArrays; ++a)
        if (!s.arrays[a].empty()) std::memcpy(arrays[a], s.arrays[a].data(), 4 * s.arrays[a].size());
}

}  // namespace spindrift::cpu
