// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/turbulence.h"
#include "core/vec.h"
#include "core/world.h"
#include "scene/distance.h"

namespace spindrift::scene
{

/// Wind on a grid before it becomes WindCells: what is read from files or computed here. Cell-centred arrays,
/// x fastest.
struct FlowField
{
    GridSize size;
    Vec3d low_m{};  ///< lower corner of cell (0,0,0), local frame
    Vec3d cell_m{1, 1, 1};
    std::vector<Vec3f> mean;            ///< m/s; zero in solid cells
    std::vector<std::uint8_t> solid;    ///< 1: solid
    std::vector<Stress<float>> stress;  ///< any symmetric tensor, also not realizable; empty: no turbulence
    std::vector<float> c0_eps;          ///< m2/s3
};

/// Records for the simulation. Solid cells take the turbulence of the nearest fluid cell, so that S does not
/// fall to zero between the last fluid centre and the wall; div_s and gradient are central differences of S
/// (one-sided at the border of the grid). No number of the result is ever NaN or infinite, whatever the
/// stress.
void fill_wind_grid(const FlowField& flow, Wind& wind);

/// What the shear closure must know about the air above.
struct ShearClosure
{
    double roughness_m = 0.1;
    double boundary_layer_m = 1000;
    double friction_velocity_m_s = 0;  ///< of the undisturbed wind; the local one is held below 1.8 of it
};

/// Makes stress and c0_eps from the mean wind's local shear and the distance to the nearest wall or the
/// ground under the grid: u* = kappa d |shear| (next to a wall from the logarithmic law), stress =
/// diag(2.5, 2.0, 1.3)^2 u*^2 in the wind's frame with the shear stress -2 nu_T S_ij, C0 eps = 5.7 u*^3 /
/// (kappa d). In a logarithmic wind over a plane this is the surface-layer closure. The bound is that of
/// QES-Turb, |tau| <= 20 u*^2: kappa d shear is far too much in the shear layers behind blocks.
void close_from_shear(const ShearClosure& closure, FlowField& flow);

}  // namespace spindrift::scene
