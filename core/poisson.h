// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/platform.h"

namespace spindrift
{

// Minus the Laplacian on a box of cells in finite volumes, one functor a step of its multigrid. A x is the
// outflow of cell i down the gradient of x: sum over its faces of c_f (x_i - x_neighbour), c_f = open area of
// the face over the distance of the centres (m), 0 at walls. Source: docs/physics.md "The solver".

/// Layout of everything that lives on the cells of a box: x fastest, one cell of border all round, which
/// holds zeros.
struct PaddedBox
{
    int nx = 0, ny = 0, nz = 0;

    SPINDRIFT_HD std::ptrdiff_t row() const { return nx + 2; }
    SPINDRIFT_HD std::ptrdiff_t plane() const { return row() * (ny + 2); }
    SPINDRIFT_HD std::ptrdiff_t count() const { return plane() * (nz + 2); }
    SPINDRIFT_HD std::ptrdiff_t index(int x, int y, int z) const
    {
        return (z + 1) * plane() + (y + 1) * row() + (x + 1);
    }
};

/// c_f of the upper face of every cell along each axis; the lower face belongs to the neighbour below, be it
/// of the border.
struct FaceCoefficients
{
    const float *x = nullptr, *y = nullptr, *z = nullptr;
    std::ptrdiff_t row = 0, plane = 0;

    /// sum c_f (u_i - u_neighbour)
    template <class R>
    SPINDRIFT_HD R outflow(const R* u, std::ptrdiff_t i) const
    {
        const R c = u[i];
        return (R(x[i - 1]) * (c - u[i - 1]) + R(x[i]) * (c - u[i + 1])) +
               (R(y[i - row]) * (c - u[i - row]) + R(y[i]) * (c - u[i + row])) +
               (R(z[i - plane]) * (c - u[i - plane]) + R(z[i]) * (c - u[i + plane]));
    }

    SPINDRIFT_HD float sum(std::ptrdiff_t i) const
    {
        return (x[i - 1] + x[i]) + (y[i - row] + y[i]) + (z[i - plane] + z[i]);
    }
};

/// 1 / sum c_f; 0 in cells that are not part of the problem.
struct DiagonalInverter
{
    FaceCoefficients c;
    float* inverse_diagonal;

    SPINDRIFT_HD void operator()(std::ptrdiff_t i) const
    {
        const float sum = c.sum(i);
        inverse_diagonal[i] = sum > 0.0F ? 1.0F / sum : 0.0F;
    }
};

/// One Gauss-Seidel update of a cell, over-relaxed by `factor`. Cells of one colour of a chequerboard do not
/// know each other, so all of a colour may be updated at once.
template <class R>
struct Smoother
{
    FaceCoefficients c;
    const float* inverse_diagonal;  ///< 0 in cells that are not part of the problem: they stay 0
    const R* b;
    R* u;
    R factor;

    SPINDRIFT_HD void operator()(std::ptrdiff_t i) const
    {
        // by way of the residual: a rounded diagonal then changes the speed, not the result
        u[i] = u[i] + factor * R(inverse_diagonal[i]) * (b[i] - c.outflow(u, i));
    }
};

/// What Smoother<float> of colour 0 makes of u = 0, in one go for both colours. `at`: x + y + z of the cell.
struct SmootherFromZero
{
    const float *inverse_diagonal, *b;
    float* u;

    SPINDRIFT_HD void operator()(std::ptrdiff_t i, int at) const
    {
        u[i] = (at & 1) == 0 ? b[i] * inverse_diagonal[i] : 0.0F;
    }
};

/// Sweeps of a V-cycle, as every backend makes them.
inline constexpr int kSmoothings = 2;  ///< before and after the coarse correction
inline constexpr int kCoarsestSmoothings = 8;

/// r = b - A u; 0 in cells that are not part of the problem.
template <class R>
struct ResidualTaker
{
    FaceCoefficients c;
    const float* inverse_diagonal;
    const R *b, *u;
    R* r;

    SPINDRIFT_HD void operator()(std::ptrdiff_t i) const
    {
        r[i] = inverse_diagonal[i] != 0.0F ? b[i] - c.outflow(u, i) : R(0);
    }
};

/// How one axis of a fine grid lies on the coarser one. An axis is halved (each coarse cell holds two fine
/// ones, the last perhaps one) or kept.
struct AxisMap
{
    const float* toward = nullptr;  ///< per fine cell: its distance from the centre of its coarse cell over
                                    ///< the distance to the next coarse centre on its side (or the border)
    int halved = 0;                 ///< 1: two to one

    SPINDRIFT_HD int parent(int fine) const { return fine >> halved; }
    /// -1 or +1 of a fine cell: which coarse neighbour it leans to.
    SPINDRIFT_HD int side(int fine) const { return (fine & 1) * 2 - 1; }
};

/// Correction of a fine grid by the coarse one: linear between coarse centres, weighted with how open the
/// coarse face is, so that nothing reaches through a wall. Exact for linear functions in free air.
struct Prolongator
{
    PaddedBox fine, coarse;
    AxisMap map[3];
    const float* open[3];  ///< share of each coarse cell's upper face that is open
    const float* coarse_u;
    const float* inverse_diagonal;  ///< of the fine grid
    float* fine_u;

    SPINDRIFT_HD void operator()(int x, int y, int z) const
    {
        const std::ptrdiff_t i = fine.index(x, y, z);
        if (inverse_diagonal[i] == 0.0F) return;
        const std::ptrdiff_t j = coarse.index(map[0].parent(x), map[1].parent(y), map[2].parent(z));
        const float own = coarse_u[j];
        fine_u[i] = fine_u[i] + (own + (lean(0, x, 1, j, own) + lean(1, y, coarse.row(), j, own) +
                                        lean(2, z, coarse.plane(), j, own)));
    }

  private:
    SPINDRIFT_HD float lean(int axis, int at, std::ptrdiff_t step, std::ptrdiff_t j, float own) const
    {
        const AxisMap& m = map[axis];
        if (m.halved == 0) return 0.0F;
        const bool up = (at & 1) != 0;
        const float share = m.toward[at] * open[axis][up ? j : j - step];
        return share * (coarse_u[up ? j + step : j - step] - own);
    }
};

/// The transpose of Prolongator: right-hand side of a coarse cell from the residuals of the fine ones.
struct Restrictor
{
    PaddedBox fine, coarse;
    AxisMap map[3];
    const float* open[3];
    const float* fine_r;
    float* coarse_b;

    SPINDRIFT_HD void operator()(int x, int y, int z) const
    {
        const int h[3] = {map[0].halved, map[1].halved, map[2].halved};
        const std::ptrdiff_t j = coarse.index(x, y, z);
        // the usual case with its loops unrolled
        coarse_b[j] = (h[0] & h[1] & h[2]) != 0 ? gather(x, y, z, j, {1, 1, 1})
                                                : gather(x, y, z, j, {h[0], h[1], h[2]});
    }

  private:
    struct Halved
    {
        int axis[3];
    };

    SPINDRIFT_HD float gather(int x, int y, int z, std::ptrdiff_t j, const Halved halved) const
    {
        const int at[3] = {x << halved.axis[0], y << halved.axis[1], z << halved.axis[2]};
        const std::ptrdiff_t coarse_step[3] = {1, coarse.row(), coarse.plane()};
        const std::ptrdiff_t fine_step[3] = {1, fine.row(), fine.plane()};
        const int cells[3] = {fine.nx, fine.ny, fine.nz};
        const float* const first = fine_r + fine.index(at[0], at[1], at[2]);
        float sum = 0;
        for (int c = 0; c <= halved.axis[2]; ++c)
            for (int b = 0; b <= halved.axis[1]; ++b)
                for (int a = 0; a <= halved.axis[0]; ++a)
                    sum += first[c * fine_step[2] + b * fine_step[1] + a];
        for (int axis = 0; axis < 3; ++axis)
        {
            if (halved.axis[axis] == 0) continue;
            const int p = (axis + 1) % 3, q = (axis + 2) % 3;
            const float* toward = map[axis].toward + at[axis];
            // children in slabs, from below: the lower neighbour's upper ones, ours, the upper neighbour's
            // lower
            float slab[4];
            for (int s = 0; s < 4; ++s)
            {
                slab[s] = 0;
                if (at[axis] + s - 1 > cells[axis]) continue;  // beyond the border: the last child is alone
                for (int c = 0; c <= halved.axis[q]; ++c)
                    for (int b = 0; b <= halved.axis[p]; ++b)
                        slab[s] += first[(s - 1) * fine_step[axis] + c * fine_step[q] + b * fine_step[p]];
            }
            const float low = open[axis][j - coarse_step[axis]], high = open[axis][j];
            sum += low * (toward[-1] * slab[0] - toward[0] * slab[1]) +
                   high * (toward[2] * slab[3] - toward[1] * slab[2]);
        }
        return sum;
    }
};

/// Largest |r| of a row of cells along x, per volume of its cell.
struct LargestPerVolume
{
    PaddedBox box;
    const double *side_x_m, *side_y_m, *side_z_m;
    const double* r;

    SPINDRIFT_HD double operator()(int y, int z) const
    {
        const std::ptrdiff_t first = box.index(0, y, z);
        double most = 0;
        for (int x = 0; x < box.nx; ++x)
        {
            const double v = r[first + x] < 0 ? -r[first + x] : r[first + x];
            const double per_length = v / side_x_m[x];
            most = most < per_length ? per_length : most;
        }
        return most / (side_y_m[y] * side_z_m[z]);
    }
};

/// How the rows of cells along x are shared out where a sum is taken: their borders depend on the box alone,
/// and so do the roundings. A row is summed in kRowLanes sums, element i in sum i % kRowLanes, which are
/// joined as
/// ((0 + 1) + (2 + 3)) + ((4 + 5) + (6 + 7)); then the rows of a chunk one after the other, then the chunks.
inline constexpr int kRowLanes = 8;
struct RowChunks
{
    std::uint32_t rows, per_chunk, count;

    SPINDRIFT_HD explicit RowChunks(const PaddedBox& box)
        : rows(static_cast<std::uint32_t>(box.ny) * static_cast<std::uint32_t>(box.nz)),
          per_chunk(box.nx < kCellsPerChunk
                        ? static_cast<std::uint32_t>(kCellsPerChunk / (box.nx > 0 ? box.nx : 1))
                        : 1U),
          count((rows + per_chunk - 1) / per_chunk)
    {
    }
    SPINDRIFT_HD std::uint32_t end(std::uint32_t chunk) const
    {
        const std::uint32_t e = (chunk + 1) * per_chunk;
        return e < rows ? e : rows;
    }

  private:
    static constexpr int kCellsPerChunk = 16384;
};

}  // namespace spindrift
