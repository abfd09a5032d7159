// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/math.h"
#include "core/number.h"
#include "core/regions.h"
#include "core/world.h"

namespace spindrift
{

/// The moving anchors of a World and where somebody put them. Host only; every backend owns one.
class Anchors
{
  public:
    explicit Anchors(const std::vector<Anchor>& anchors)
    {
        for (const Anchor& anchor : anchors)
            keys_.insert(keys_.end(), anchor.keys.begin(), anchor.keys.end());
        std::size_t first = 0;
        for (const Anchor& anchor : anchors)
        {
            views_.push_back(
                {keys_.data() + first, static_cast<std::uint32_t>(anchor.keys.size()), false, {}});
            first += anchor.keys.size();
        }
    }
    Anchors(const Anchors&) = delete;
    Anchors& operator=(const Anchors&) = delete;

    /// Throws Error if there is no such anchor or the place is not finite.
    void set(int index, Vec3f p)
    {
        if (index < 0 || static_cast<std::size_t>(index) >= views_.size())
            throw Error("anchor " + std::to_string(index) + " does not exist; the scene has " +
                        std::to_string(views_.size()));
        if (!(is_finite(p.x) && is_finite(p.y) && is_finite(p.z)))
            throw Error("anchor " + std::to_string(index) +
                        " was put at a place that is not finite; give metres");
        views_[static_cast<std::size_t>(index)].placed = true;
        views_[static_cast<std::size_t>(index)].place = p;
    }

    /// By anchor; their keys lie in keys(), one anchor's after the other's.
    const std::vector<AnchorView>& views() const { return views_; }
    const std::vector<Anchor::Key>& keys() const { return keys_; }

    /// Words an anchor in a snapshot.
    static constexpr std::size_t kWords = 3;
    std::size_t words() const { return kWords * views_.size(); }

    void save(std::vector<std::uint64_t>& words) const
    {
        for (const AnchorView& anchor : views_)
        {
            const Vec3f v = anchor.placed ? anchor.place : Vec3f{0, 0, 0};
            words.push_back(anchor.placed ? 1U : 0U);
            words.push_back(std::uint64_t{bits(v.x)} << 32 | bits(v.y));
            words.push_back(bits(v.z));
        }
    }
    void restore(const std::uint64_t* words)
    {
        const auto number = [](std::uint64_t word) { return from_bits(static_cast<std::uint32_t>(word)); };
        for (AnchorView& anchor : views_)
        {
            anchor.placed = words[0] != 0;
            anchor.place = {number(words[1] >> 32), number(words[1]), number(words[2])};
            words += kWords;
        }
    }

  private:
    std::vector<Anchor::Key> keys_;
    std::vector<AnchorView> views_;
};

}  // namespace spindrift
