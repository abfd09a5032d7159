// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/lamp_clusters.h"
#include "core/light.h"
#include "core/view.h"

namespace spindrift::gl
{

/// The clusters of a view with the lamps that reach each of them.
class ClusteredLamps
{
  public:
    /// Sorts the lamps into clusters; a bit too many is set at most, never one too few. Pure.
    ClusteredLamps(std::span<const Lamp<float>> lamps, const View& view);
    ClusteredLamps() = default;

    LampClusters view() const { return {grid_, words_, lit_.data(), on_the_way_.data()}; }

  private:
    ClusterGrid grid_;
    std::size_t words_ = 0;
    std::vector<std::uint32_t> lit_, on_the_way_;
};

/// The block LampClusters of shaders/lights.glsl.
std::vector<std::uint32_t> pack(const LampClusters& clusters);

/// How many of the lamps end somewhere: the others reach every cluster.
std::size_t count_bounded(std::span<const Lamp<float>> lamps);

}  // namespace spindrift::gl
