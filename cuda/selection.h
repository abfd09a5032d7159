// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/platform.h"
#include "cuda/buffer.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

/// Slots of a tile: a block's worth of threads.
inline constexpr unsigned kSelectionTile = 1024;

SPINDRIFT_HD std::size_t selection_tiles(std::size_t slots)
{
    return (slots + kSelectionTile - 1) / kSelectionTile;
}

/// Device addresses of the working memory of a selection (cuda/selection.cuh).
struct Selection
{
    std::uint32_t* words;        ///< a bit a slot
    std::uint32_t* tile_starts;  ///< chosen slots of a tile, then those before it
};

/// Owns it: a little over a bit a slot.
class SelectionMemory
{
  public:
    explicit SelectionMemory(std::size_t capacity)
        : words_(selection_tiles(capacity) * (kSelectionTile / 32)), starts_(selection_tiles(capacity))
    {
    }
    Selection get() const { return {words_.data(), starts_.data()}; }

  private:
    DeviceBuffer<std::uint32_t> words_, starts_;
};

/// Turns the counts of the tiles of *count slots into their starts and writes the sum to `total`.
void number_tiles(StreamRef stream, const std::uint32_t* count, const Selection& selection,
                  std::uint32_t* total);

}  // namespace spindrift::gpu
