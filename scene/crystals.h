// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace spindrift::scene
{

/// How many crystal shapes flakes choose from.
inline constexpr int kCrystalShapes = 12;
/// Edge of a mask's finest level in texels.
inline constexpr int kCrystalMaskPx = 128;

/// The outline of a grown snow crystal: coverage (255: ice) over the square that encloses the unit disc.
struct CrystalMask
{
    /// Mip levels, [0] is the finest; row-major, row 0 at v = -1, column 0 at u = -1. Each level is the 2x2
    /// mean of the finer one.
    std::vector<std::vector<std::uint8_t>> levels;
    /// Mean over the unit disc, weighted with the flake's Gaussian exp(-rho^2 / (2 kProfileSigma^2)).
    double mean = 0;
};

/// Grows the six-fold shapes with Reiter's hexagonal automaton (Chaos, Solitons & Fractals 23, 2005). In
/// integers, so that they are exactly symmetric and the same everywhere.
std::vector<CrystalMask> grow_crystals();

/// The same, grown at the first call and kept for the life of the program.
const std::vector<CrystalMask>& crystal_masks();

/// Bilinear sample in [0, 1] at disc coordinates u, v in [-1, 1] of the mip level nearest to `level`, edges
/// clamped: what the texture unit gives.
double sample_mask(const CrystalMask& mask, double u, double v, double level);

}  // namespace spindrift::scene
