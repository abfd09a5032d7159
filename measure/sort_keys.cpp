// SPDX-License-Identifier: MIT
#include "measure/sort_keys.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace spindrift::measure
{

namespace
{

// The cloud: large enough that half of it lies before the camera whichever way it looks.
constexpr float kCloudWidth_m = 200.0F;
constexpr float kCloudHeight_m = 40.0F;
constexpr float kFlakesPerPair = 2.5F;

void fill(std::vector<float>& values, float top, std::mt19937& random)
{
    std::uniform_real_distribution<float> anywhere(0.0F, top);
    for (float& value : values) value = anywhere(random);
}

}  // namespace

std::string_view pattern_name(KeyPattern pattern)
{
    switch (pattern)
    {
        case KeyPattern::random:
            return "random";
        case KeyPattern::nearly_sorted:
            return "nearly-sorted";
        case KeyPattern::equal:
            return "equal";
        case KeyPattern::camera_sweep:
            return "camera-sweep";
    }
    return "";
}

PairSource::PairSource(KeyPattern pattern, std::size_t n) : pattern_(pattern), pairs_(n)
{
    std::mt19937 random(1);
    if (pattern == KeyPattern::camera_sweep)
    {
        const auto flakes = static_cast<std::size_t>(kFlakesPerPair * static_cast<float>(n)) + 64;
        for (auto* axis : {&x_, &y_, &z_}) axis->resize(flakes);
        fill(x_, kCloudWidth_m, random);
        fill(y_, kCloudWidth_m, random);
        fill(z_, kCloudHeight_m, random);
        return;
    }
    std::vector<std::uint32_t> keys(n, 0x4048'f5c3U);
    if (pattern != KeyPattern::equal)
        for (auto& key : keys) key = static_cast<std::uint32_t>(random());
    if (pattern == KeyPattern::nearly_sorted)
    {
        std::ranges::sort(keys);
        for (std::size_t swaps = n / 100; swaps > 0; --swaps)
            std::swap(keys[random() % n], keys[random() % n]);
    }
    for (std::size_t i = 0; i < n; ++i) pairs_[i] = std::uint64_t{keys[i]} << 32 | i;
}

std::size_t PairSource::slots() const
{
    return changes() ? x_.size() : pairs_.size();
}

std::span<const std::uint64_t> PairSource::next_frame()
{
    const std::size_t count = pattern_ == KeyPattern::camera_sweep ? sweep_camera() : pairs_.size();
    ++frame_;
    return {pairs_.data(), count};
}

std::uint64_t PairSource::narrowed(std::uint64_t pair, int key_bits) const
{
    if (key_bits == 32) return pair;
    const auto key = static_cast<std::uint32_t>(pair >> 32);
    const std::uint64_t slot = pair & 0xffff'ffffU;
    if (pattern_ != KeyPattern::camera_sweep) return std::uint64_t{key >> (32 - key_bits)} << 32 | slot;
    const float nearness = std::max(0.0F, 1.0F - std::sqrt(std::bit_cast<float>(~key)) / kCloudWidth_m);
    const auto buckets = static_cast<float>((1U << key_bits) - 1U);
    return static_cast<std::uint64_t>(nearness * buckets) << 32 | slot;
}

// The camera walks 0.1 m and turns by 1 degree a frame round the middle of the cloud. A key is the inverted
// bit pattern of the squared distance, so that far comes first; what lies behind the camera is culled.
// Returns the number of pairs.
std::size_t PairSource::sweep_camera()
{
    const float angle = static_cast<float>(frame_) * std::numbers::pi_v<float> / 180.0F;
    const float forward_x = std::cos(angle);
    const float forward_y = std::sin(angle);
    const float eye_x = 0.5F * kCloudWidth_m + 0.1F * static_cast<float>(frame_ % 100);
    const float eye_y = 0.5F * kCloudWidth_m;
    const float eye_z = 1.6F;
    std::size_t seen = 0;
    for (std::size_t slot = 0; slot < x_.size() && seen < pairs_.size(); ++slot)
    {
        const float dx = x_[slot] - eye_x;
        const float dy = y_[slot] - eye_y;
        const float dz = z_[slot] - eye_z;
        if (dx * forward_x + dy * forward_y <= 0) continue;
        const auto key = ~std::bit_cast<std::uint32_t>(dx * dx + dy * dy + dz * dz);
        pairs_[seen++] = std::uint64_t{key} << 32 | slot;
    }
    return seen;
}

}  // namespace spindrift::measure
