// SPDX-License-Identifier: MIT
#include "cpu/anchors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"

namespace spindrift::cpu
{

namespace
{

float between(float a, float b, double t)
{
    return static_cast<float>(static_cast<double>(a) + t * (static_cast<double>(b) - static_cast<double>(a)));
}

}  // namespace

Anchors::Anchors(std::vector<Anchor> anchors) : anchors_(std::move(anchors)), placed_(anchors_.size()) {}

void Anchors::set(int index, Vec3f p)
{
    if (index < 0 || static_cast<std::size_t>(index) >= anchors_.size())
        throw Error(fmt::format("anchor {} does not exist; the scene has {}", index, anchors_.size()));
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw Error(fmt::format("anchor {} was put at a place that is not finite; give metres", index));
    placed_[static_cast<std::size_t>(index)] = p;
}

Vec3f Anchors::at(int index, double time_s) const
{
    const auto i = static_cast<std::size_t>(index);
    if (placed_[i]) return *placed_[i];
    const std::vector<Anchor::Key>& keys = anchors_[i].keys;
    const auto after = std::upper_bound(keys.begin(), keys.end(), time_s,
                                        [](double t, const Anchor::Key& key) { return t < key.time_s; });
    if (after == keys.begin()) return keys.front().position_m;
    if (after == keys.end()) return keys.back().position_m;
    const Anchor::Key& a = *(after - 1);
    const Anchor::Key& b = *after;
    const double t = (time_s - a.time_s) / (b.time_s - a.time_s);
    return {between(a.position_m.x, b.position_m.x, t), between(a.position_m.y, b.position_m.y, t),
            between(a.position_m.z, b.position_m.z, t)};
}

std::vector<std::uint64_t> Anchors::save() const
{
    std::vector<std::uint64_t> words;
    for (const std::optional<Vec3f>& p : placed_)
    {
        const Vec3f v = p.value_or(Vec3f{0, 0, 0});
        words.push_back(p ? 1U : 0U);
        words.push_back(std::uint64_t{std::bit_cast<std::uint32_t>(v.x)} << 32 |
                        std::bit_cast<std::uint32_t>(v.y));
        words.push_back(std::bit_cast<std::uint32_t>(v.z));
    }
    return words;
}

void Anchors::restore(const std::uint64_t* state)
{
    const auto number = [](std::uint64_t bits)
    { return std::bit_cast<float>(static_cast<std::uint32_t>(bits)); };
    for (std::optional<Vec3f>& p : placed_)
    {
        p.reset();
        if (state[0] != 0) p = Vec3f{number(state[1] >> 32), number(state[1]), number(state[2])};
        state += 3;
    }
}

}  // namespace spindrift::cpu
