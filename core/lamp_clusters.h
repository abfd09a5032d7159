// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math.h"

namespace spindrift
{

// Which lamps count where: the space that the camera sees is cut into clusters, columns by rows of the
// picture by slices of depth, and each cluster has a bit for each lamp. A lamp whose bit is not set gives
// nothing there, exactly: its range or cone ends before.

/// The clusters of a view. Columns and rows cover the picture and the guard band round it; what lies farther
/// out counts as the outermost. Slice 0 ends at a depth, each of the next ones is so many times as deep, the
/// last one has no end.
struct ClusterGrid
{
    static constexpr int kColumns = 24, kRows = 16, kSlices = 20;

    float left_px = 0, bottom_px = 0;  ///< of the grid, from the lower left corner of the picture
    float columns_per_px = 0, rows_per_px = 0;
    float first_log2 = 0;  ///< of the depth in m at which slice 0 ends
    float slices_per_log2 = 1;

    static constexpr std::size_t count() { return std::size_t{kColumns} * kRows * kSlices; }
};

/// The cluster of a place: px from the lower left corner of the picture, depth along the view in m.
template <class R>
SPINDRIFT_HD IntOf<R> cluster_of(const ClusterGrid& grid, const R& x_px, const R& y_px, const R& depth_m)
{
    using Int = IntOf<R>;
    const auto inside = [](const R& at, int count)
    { return truncate_to_int(clamp(at, number<R>(0), number<R>(count - 1))); };
    const Int column = inside((x_px - R(grid.left_px)) * R(grid.columns_per_px), ClusterGrid::kColumns);
    const Int row = inside((y_px - R(grid.bottom_px)) * R(grid.rows_per_px), ClusterGrid::kRows);
    const R beyond = (log2(max(depth_m, number<R>(1e-6))) - R(grid.first_log2)) * R(grid.slices_per_log2);
    const Int slice = inside(beyond + number<R>(1), ClusterGrid::kSlices);
    return (slice * Int(ClusterGrid::kRows) + row) * Int(ClusterGrid::kColumns) + column;
}

/// The bits of all clusters, cluster by cluster, lamp 32 w + b being bit b of word w; not owned.
struct LampClusters
{
    ClusterGrid grid;
    std::size_t words = 0;               ///< of a cluster; 0: no clusters, every lamp counts everywhere
    const std::uint32_t* lit = nullptr;  ///< lamps that reach into the cluster
    /// Lamps that reach the way from the eye to some place in the cluster.
    const std::uint32_t* on_the_way = nullptr;
};

}  // namespace spindrift
