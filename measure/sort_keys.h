// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace spindrift::measure
{

enum class KeyPattern
{
    random,         ///< uniform over all 32-bit keys
    nearly_sorted,  ///< ascending but for one pair in fifty, swapped with any other
    equal,          ///< one key for all
    camera_sweep,   ///< frames of a camera that moves and turns in a cloud of flakes
};

inline constexpr std::array kKeyPatterns{KeyPattern::random, KeyPattern::nearly_sorted, KeyPattern::equal,
                                         KeyPattern::camera_sweep};

std::string_view pattern_name(KeyPattern pattern);

/// The inputs of one series of measurements: pairs (key << 32 | slot), slots ascending.
class PairSource
{
  public:
    PairSource(KeyPattern pattern, std::size_t n);

    std::size_t slots() const;  ///< every slot is less
    bool changes() const { return pattern_ == KeyPattern::camera_sweep; }

    /// The pairs of the next frame; only the camera sweep changes from frame to frame.
    std::span<const std::uint64_t> next_frame();

    /// The same pair with a narrower key: the upper bits, or for the camera sweep linear buckets of distance.
    std::uint64_t narrowed(std::uint64_t pair, int key_bits) const;

  private:
    std::size_t sweep_camera();

    KeyPattern pattern_;
    std::size_t frame_ = 0;
    std::vector<std::uint64_t> pairs_;
    std::vector<float> x_, y_, z_;  // m; the cloud of the camera sweep
};

}  // namespace spindrift::measure
