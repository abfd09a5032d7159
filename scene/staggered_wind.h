// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"
#include "scene/distance.h"

namespace spindrift::scene
{

/// Wind on the faces of cells (Arakawa C grid): u on faces across x, (nx+1) ny nz of them, v and w likewise;
/// x fastest. m/s. The sides and the top are open, the ground is closed.
struct StaggeredWind
{
    GridSize size;
    Vec3d cell_m{1, 1, 1};
    std::vector<double> u, v, w;
    std::vector<std::uint8_t> solid;  ///< 1: solid

    StaggeredWind() = default;
    StaggeredWind(GridSize grid, Vec3d cell);

    GridSize u_size() const { return {size.nx + 1, size.ny, size.nz}; }
    GridSize v_size() const { return {size.nx, size.ny + 1, size.nz}; }
    GridSize w_size() const { return {size.nx, size.ny, size.nz + 1}; }

    /// Net outflow of a cell over its volume, 1/s.
    double divergence(int x, int y, int z) const;

    /// Mean of opposite faces.
    Vec3f centre(int x, int y, int z) const;
};

struct Projection
{
    double before_per_s = 0;  ///< largest |divergence| of a fluid cell once the solids are closed
    double after_per_s = 0;
    int iterations = 0;
};

/// Closes the faces of solid cells and of the ground and takes away the divergence with the least change of
/// the wind (Sherman 1978): u <- u + grad lambda with lambda = 0 beyond the open border and no flow through
/// walls, by conjugate gradients with the modified incomplete Cholesky preconditioner, in double. Air that is
/// shut in comes to rest. Afterwards |div u| <= 1e-6 U / h in every fluid cell, U the largest speed and h the
/// smallest side of a cell. Throws Error if that is not reached.
Projection make_divergence_free(StaggeredWind& wind);

}  // namespace spindrift::scene
