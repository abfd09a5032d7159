// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/world.h"

namespace spindrift::cpu
{

/// Where the moving anchors of a World are: on their keys, or where somebody put them.
class Anchors
{
  public:
    explicit Anchors(std::vector<Anchor> anchors);

    /// Throws Error if there is no such anchor or the place is not finite.
    void set(int index, Vec3f position_m);

    Vec3f at(int index, double time_s) const;

    /// Three numbers an anchor.
    std::vector<std::uint64_t> save() const;
    void restore(const std::uint64_t* state);
    std::size_t count() const { return anchors_.size(); }

  private:
    std::vector<Anchor> anchors_;
    std::vector<std::optional<Vec3f>> placed_;
};

}  // namespace spindrift::cpu
