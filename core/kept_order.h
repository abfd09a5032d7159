// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/view.h"

namespace spindrift
{

/// A slot that had no place in the order of the last frame.
inline constexpr std::uint32_t kNoRank = ~0U;

/// From what a sort over frames begins.
enum class SortStart
{
    exact,    ///< the order of the last frame is of no use: sort anew
    as_kept,  ///< the order of the last frame; the first time: ascending slots
};

/// What keeping an order moves, in bytes a pair: places cleared, filled and closed up, new pairs taken out
/// and put behind, ranks cleared and written.
inline constexpr double kKeptOrderBytesPerPair = 8 + 20 + 16 + 12 + 12 + 16;

/// Whether a sort that goes on from the order of the last frame may do so. Decided alike on every backend.
class KeptOrder
{
  public:
    /// For each frame that is sorted so. Exact if no order is kept, or if the view turned or moved so far in
    /// one frame that the old one says little.
    SortStart next(const View& view)
    {
        const bool goes_on = kept_ && !jumped(view_, view);
        kept_ = true;
        view_ = view;
        return goes_on ? SortStart::as_kept : SortStart::exact;
    }
    /// Slots stand for flakes that nobody followed, as in a restored snapshot, or another sort ran.
    void forget() { kept_ = false; }

  private:
    static bool jumped(const View& a, const View& b)
    {
        constexpr float kFar_m = 5;
        constexpr float kCosineOfTurn = 0.966F;  // 15 degrees
        const Vec3f moved = b.eye - a.eye;
        return dot(moved, moved) > kFar_m * kFar_m || dot(a.forward, b.forward) < kCosineOfTurn;
    }

    bool kept_ = false;
    View view_{};
};

}  // namespace spindrift
