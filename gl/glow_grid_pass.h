// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/glow_grid.h"
#include "core/light.h"
#include "core/view.h"
#include "gl/object.h"
#include "gl/program.h"

namespace spindrift::gl
{

/// By lamp the number of its grid, -1 where none pays: lamps that are seen by too few of the ways (pixels and
/// flakes), the first `shadowed`, spots, whose cones a grid would blur, and those without a range. Pure.
std::vector<std::int32_t> lamps_in_grids(std::span<const Lamp<float>> lamps, std::size_t shadowed,
                                         const View& view, double flakes);

/// How many of them have one.
std::size_t count_grids(std::span<const std::int32_t> of_lamp);

/// Integrates the glow of lamps into grids.
class GlowGridPass
{
  public:
    /// What lies behind the bits of the clusters in their buffer: by lamp the number of its grid, then nodes.
    struct Room
    {
        GLuint buffer = 0;
        std::size_t nodes_at = 0;  ///< words from the start of the buffer
        std::span<const std::int32_t> of_lamp;
    };
    /// `room` is bound as LampClusters, lights and air as for every lit shader.
    void fill(const Room& room);
    /// The nodes in the host's memory, until the next call.
    GlowGrids on_host(const Room& room);

  private:
    Program program_;  ///< made when it is first needed
    std::vector<float> nodes_;
};

}  // namespace spindrift::gl
