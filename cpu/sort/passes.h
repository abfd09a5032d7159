// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/kept_order.h"
#include "core/sort_network.h"
#include "cpu/sort/strategy.h"

namespace spindrift::cpu
{

/// Sorts over frames: each frame's pairs are put in the order that the last frame ended in, those that were
/// not there behind them, and a few steps of a sorting network bring the whole nearer to the order of its
/// keys. Between two calls a slot must stand for the same flake, or its rank must have gone where the flake
/// went.
class PassSorter
{
  public:
    /// `slots`: every slot is less. Takes 12 bytes a slot.
    PassSorter(Network network, std::size_t slots);

    /// Returns where the pairs are: job.pairs or job.scratch.
    std::uint64_t* sort(const SortJob& job, int passes, SortStart start);

    Network network() const { return network_; }
    /// By slot: its place in the last frame's order, or kNoRank.
    std::uint32_t* ranks() { return rank_.data(); }

  private:
    std::uint64_t* in_kept_order(const SortJob& job);
    void run_steps(std::uint64_t* pairs, std::size_t n, int passes);
    void keep_order(const std::uint64_t* pairs, std::size_t n);

    Network network_;
    NetworkWalk walk_;
    std::vector<std::uint32_t> rank_;
    std::vector<std::uint64_t> places_;                  ///< pairs at their places of the last frame
    std::size_t kept_ = 0;                               ///< places that the last frame had
    std::vector<std::size_t> kept_starts_, new_starts_;  ///< by chunk
};

}  // namespace spindrift::cpu
