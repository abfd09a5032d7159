// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>

#include "core/vec.h"
#include "core/world.h"
#include "scene/distance.h"
#include "scene/mesh.h"

namespace spindrift::scene
{

/// Largest number of voxels that a scene may ask for; two bytes each.
inline constexpr std::size_t kMostVoxels = std::size_t{512} << 20;

/// Fills an occupancy grid over the domain [0, size] with the solid things of a scene. Local frame, metres.
class Voxeliser
{
  public:
    using Height = std::function<double(double x_m, double y_m)>;

    /// `floor_m`: height of the ground; nothing is reached from below it, so houses without a floor are solid
    /// too. Empty: no ground. Throws Error if the grid would have more than kMostVoxels cells.
    Voxeliser(Vec3f size_m, double cell_m, Height floor_m);

    GridSize size() const { return size_; }
    Vec3d centre(int x, int y, int z) const;

    /// Every cell that a triangle touches (a wall exactly between two cells takes the inner one), and every
    /// cell that cannot be reached from outside the mesh through cells that share a face: closed models are
    /// solid, open ones a shell.
    void add_mesh(const Mesh& mesh, std::uint8_t surface);

    /// The cells between the faces of the box, each moved to the nearest cell border; at least one cell
    /// thick.
    void add_box(Vec3d min_m, Vec3d max_m, std::uint8_t surface);

    /// Every column up to the height over its middle.
    void add_height_field(const Height& height_m, std::uint8_t surface);

    /// Every cell whose centre is inside.
    void add_where(const std::function<bool(Vec3d)>& inside, std::uint8_t surface);

    bool solid(int x, int y, int z) const { return grid_.clearance[size_.index(x, y, z)] == 0; }

    /// The grid with its distances; an empty one if nothing is solid. The voxeliser is used up.
    VoxelGrid finish();

  private:
    void fill(int x, int y, int z, std::uint8_t surface);

    GridSize size_;
    double cell_m_;
    Height floor_m_;
    bool anything_ = false;
    VoxelGrid grid_;
};

}  // namespace spindrift::scene
