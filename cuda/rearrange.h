// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/cell_order.h"
#include "cuda/buffer.h"
#include "cuda/flake_memory.h"
#include "cuda/selection.h"
#include "cuda/step_control.h"

namespace spindrift::gpu
{

/// Gives the flakes other slots, in place: a list of sources in a quarter of the draw list's memory, through
/// whose other three quarters the arrays pass three at a time. The draw list is lost. `ranks`
/// (DeviceSort::ranks), unless it is null, go with the flakes; slots that fall free have kNoRank.
class Rearranger
{
  public:
    enum class Reorders
    {
        no,
        yes,  ///< needs the working memory of a sort
    };
    Rearranger(std::size_t capacity, Reorders reorders, int key_bits);

    /// Closes the holes of StepControl::closing slots; the order of the others stays. Does nothing where that
    /// is 0.
    void close_holes(StreamRef stream, const StepControl* control, const FlakeAddresses& at,
                     const Selection& selection, std::uint32_t* ranks) const;

    /// The same, and puts the flakes in the order of their wind cells; those of one cell keep theirs.
    void reorder(StreamRef stream, const StepControl* control, const FlakeAddresses& at,
                 const CellOrder& order, std::uint32_t* ranks) const;

  private:
    std::size_t capacity_;
    int key_bits_;
    DeviceBuffer<std::uint32_t> total_;
    DeviceBuffer<unsigned char> sort_;
};

}  // namespace spindrift::gpu
