// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/flake.h"

namespace spindrift::cpu
{

/// Closes the holes that dead flakes leave, in place; the order of the others stays.
class Compactor
{
  public:
    explicit Compactor(std::size_t capacity);

    /// Returns how many slots are used afterwards: the alive flakes of [0, used). `ranks`, unless it is null,
    /// go with them; slots that fall free have kNoRank.
    std::size_t operator()(const FlakeView& flakes, std::size_t used, std::uint32_t* ranks);

  private:
    std::vector<std::uint64_t> alive_;  ///< one bit a slot
};

}  // namespace spindrift::cpu
