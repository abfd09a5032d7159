// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/grid_size.h"
#include "core/vec.h"

namespace spindrift
{

/// Wind on the faces of cells (Arakawa C grid): u on faces across x, (nx+1) ny nz of them, v and w likewise;
/// x fastest. m/s. The sides and the top are open, the ground is closed.
struct StaggeredWind
{
    GridSize size;
    Vec3d cell_m{1, 1, 1};        ///< z: of the thinnest layer
    std::vector<double> layer_m;  ///< thickness of each layer of cells, bottom to top
    std::vector<double> u, v, w;
    std::vector<std::uint8_t> solid;  ///< 1: solid

    StaggeredWind() = default;

    /// At rest and without solids; all layers equally thick.
    StaggeredWind(GridSize grid, Vec3d cell)
        : StaggeredWind(grid, cell, std::vector<double>(static_cast<std::size_t>(grid.nz), cell.z))
    {
    }

    StaggeredWind(GridSize grid, Vec3d cell, std::vector<double> layers)
        : size(grid), cell_m(cell), layer_m(std::move(layers))
    {
        for (const double layer : layer_m) cell_m.z = layer < cell_m.z ? layer : cell_m.z;
        u.assign(u_size().count(), 0);
        v.assign(v_size().count(), 0);
        w.assign(w_size().count(), 0);
        solid.assign(size.count(), 0);
    }

    GridSize u_size() const { return {size.nx + 1, size.ny, size.nz}; }
    GridSize v_size() const { return {size.nx, size.ny + 1, size.nz}; }
    GridSize w_size() const { return {size.nx, size.ny, size.nz + 1}; }

    /// Net outflow of a cell over its volume, 1/s.
    double divergence(int x, int y, int z) const
    {
        return (u[u_size().index(x + 1, y, z)] - u[u_size().index(x, y, z)]) / cell_m.x +
               (v[v_size().index(x, y + 1, z)] - v[v_size().index(x, y, z)]) / cell_m.y +
               (w[w_size().index(x, y, z + 1)] - w[w_size().index(x, y, z)]) /
                   layer_m[static_cast<std::size_t>(z)];
    }

    /// Mean of opposite faces.
    Vec3f centre(int x, int y, int z) const
    {
        const auto mean = [](double a, double b) { return static_cast<float>(0.5 * (a + b)); };
        return {mean(u[u_size().index(x, y, z)], u[u_size().index(x + 1, y, z)]),
                mean(v[v_size().index(x, y, z)], v[v_size().index(x, y + 1, z)]),
                mean(w[w_size().index(x, y, z)], w[w_size().index(x, y, z + 1)])};
    }
};

/// What a projection did.
struct Projection
{
    double before_per_s = 0;  ///< largest |divergence| of a fluid cell once the solids are closed
    double after_per_s = 0;
    double relative_residual = 0;  ///< of the Poisson equation, L2 over L2 of its right-hand side
    int iterations = 0;
};

/// Closes the faces of solid cells and of the ground and takes away the divergence with the least change of
/// the wind (Sherman 1978): u <- u + grad lambda with lambda = 0 on the open border and no flow through
/// walls. Air that is shut in comes to rest. Afterwards |div u| <= 1e-6 U / h in every fluid cell, U the
/// largest speed and h the smallest side of a cell. Throws Error if that is not reached. Each backend has its
/// own; the parts that need one are handed it.
using WindProjector = std::function<Projection(StaggeredWind&)>;

}  // namespace spindrift
