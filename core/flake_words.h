// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/flake.h"
#include "core/platform.h"

namespace spindrift
{

/// Of an element of FlakeView::state.
SPINDRIFT_HD bool is_alive(std::uint32_t state)
{
    return (state & 0xFFU) == static_cast<std::uint32_t>(Fate::alive);
}

inline constexpr std::size_t kFlakeArrays = 11;
inline constexpr std::size_t kFlakeFloatArrays = 9;  ///< they come first

/// The eleven arrays as words, whatever they mean, to move and copy them; on the host by memcpy alone.
inline std::array<std::uint32_t*, kFlakeArrays> flake_words(const FlakeView& f)
{
    const auto words = [](float* array) { return reinterpret_cast<std::uint32_t*>(array); };
    return {words(f.x),      words(f.y),      words(f.z),      words(f.q1), words(f.q2), words(f.q3),
            words(f.slip_x), words(f.slip_y), words(f.slip_z), f.id,        f.state};
}

}  // namespace spindrift
