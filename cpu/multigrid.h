// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/poisson.h"

namespace spindrift::cpu
{

/// -div grad on a box of cells: which of them take part, how large they are, and what holds at the border.
struct PoissonProblem
{
    std::array<std::vector<double>, 3> side_m;  ///< of the columns, rows and layers of cells
    std::vector<std::uint8_t> part;             ///< 1: an unknown; x fastest, no border. Else a wall
    std::array<bool, 6> zero_border{};  ///< x low, x high, y low ...: 0 on that face of the box; else a wall
};

/// The grids of a geometric multigrid, finest first. Axes are halved while their cells are the shortest
/// (semi-coarsening), a coarse face is as open as its fine faces are on average, prolongation and restriction
/// are each other's transpose and the smoothers mirror each other, so that one cycle is a symmetric
/// preconditioner. Single precision.
class Multigrid
{
  public:
    explicit Multigrid(const PoissonProblem& problem);

    const PaddedBox& box() const { return levels_.front().box; }
    FaceCoefficients coefficients() const { return levels_.front().coefficients(); }
    const float* inverse_diagonal() const { return levels_.front().inverse_diagonal.data(); }
    std::size_t levels() const { return levels_.size(); }

    /// Right-hand side and result of cycle(), on the finest grid; the border holds zeros.
    float* right_hand_side() { return levels_.front().b.data(); }
    const float* result() const { return levels_.front().u.data(); }

    /// One V-cycle from zero.
    void cycle() { cycle(0); }

  private:
    struct Level
    {
        PaddedBox box;
        std::array<std::vector<double>, 3> side_m;
        std::array<std::vector<float>, 3> face;  ///< c_f
        std::array<std::vector<float>, 3> open;  ///< coarser levels only
        std::vector<float> inverse_diagonal, u, b, r;
        std::array<int, 3> halved{};               ///< on the way to the next level
        std::array<std::vector<float>, 3> toward;  ///< with two entries more in front and behind

        Level(const std::array<std::vector<double>, 3>& sides);
        FaceCoefficients coefficients() const
        {
            return {face[0].data(), face[1].data(), face[2].data(), box.row(), box.plane()};
        }
        AxisMap map(int axis) const { return {toward[axis].data() + 2, halved[axis]}; }
        void invert_diagonal();
        /// Halves what has the shortest cells; false: nothing is left to halve.
        bool choose_axes();
    };

    void add_coarser();
    void cycle(std::size_t level);
    static void average_faces(const Level& fine, Level& coarse, int axis);
    static void solve_coarsest(Level& level);
    static void smooth(Level& level, int colour);
    static void smooth_from_zero(Level& level);
    static void take_residual(Level& level);
    static void restrict_to(Level& coarse, const Level& fine);
    static void prolong(Level& fine, const Level& coarse);

    std::vector<Level> levels_;
};

}  // namespace spindrift::cpu
