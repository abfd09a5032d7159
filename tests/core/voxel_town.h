// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "core/walk.h"
#include "core/world.h"

namespace spindrift_test
{

/// A small world of voxels whose solid cells a test sets one by one.
class VoxelTown
{
  public:
    VoxelTown(int nx, int ny, int nz, float cell_m, spindrift::Vec3f origin_m)
    {
        spindrift::VoxelGrid& grid = world_.voxels;
        grid.nx = nx, grid.ny = ny, grid.nz = nz;
        grid.cell_m = cell_m;
        grid.origin_m = origin_m;
        const auto cells =
            static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz);
        grid.clearance.assign(cells + 3, 255);
        grid.surface.assign(cells, 0);
        world_.surfaces = {{spindrift::Contact::bounce, 0.5F}};
        world_.has_ground = false;
    }

    spindrift::World& world() { return world_; }

    void solid(int x, int y, int z, int surface = 0)
    {
        world_.voxels.clearance[index(x, y, z)] = 0;
        world_.voxels.surface[index(x, y, z)] = static_cast<std::uint8_t>(surface);
    }

    bool is_solid(int x, int y, int z) const
    {
        const spindrift::VoxelGrid& g = world_.voxels;
        if (x < 0 || y < 0 || z < 0 || x >= g.nx || y >= g.ny || z >= g.nz) return false;
        return g.clearance[index(x, y, z)] == 0;
    }

    /// Sets the clearance of the free cells; the view is good until the next change.
    spindrift::Solids finish()
    {
        spindrift::VoxelGrid& g = world_.voxels;
        for (int z = 0; z < g.nz; ++z)
            for (int y = 0; y < g.ny; ++y)
                for (int x = 0; x < g.nx; ++x)
                    if (!is_solid(x, y, z)) g.clearance[index(x, y, z)] = distance_from(x, y, z);
        return spindrift::solids_view(world_);
    }

  private:
    std::size_t index(int x, int y, int z) const
    {
        const spindrift::VoxelGrid& g = world_.voxels;
        return static_cast<std::size_t>((z * g.ny + y) * g.nx + x);
    }

    std::uint8_t distance_from(int x, int y, int z) const
    {
        for (int r = 1; r < 8; ++r)
            for (int k = -r; k <= r; ++k)
                for (int j = -r; j <= r; ++j)
                    for (int i = -r; i <= r; ++i)
                        if (is_solid(x + i, y + j, z + k)) return static_cast<std::uint8_t>(r);
        return 8;  // or more: any lower bound will do
    }

    spindrift::World world_;
};

}  // namespace spindrift_test
