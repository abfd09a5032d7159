// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/poisson.h"
#include "core/poisson_levels.h"

namespace spindrift::cpu
{

/// A geometric multigrid on the threads of the current arena. Prolongation and restriction are each other's
/// transpose and the smoothers mirror each other, so that one cycle is a symmetric preconditioner. Single
/// precision.
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
    struct Level : PoissonLevel
    {
        std::vector<float> inverse_diagonal, u, b, r;

        explicit Level(PoissonLevel grid);
        FaceCoefficients coefficients() const
        {
            return {face[0].data(), face[1].data(), face[2].data(), box.row(), box.plane()};
        }
        AxisMap map(int axis) const { return {toward[axis].data() + 2, halved[axis]}; }
    };

    void cycle(std::size_t level);
    static void solve_coarsest(Level& level);
    static void smooth(Level& level, int colour);
    static void smooth_from_zero(Level& level);
    static void take_residual(Level& level);
    static void restrict_to(Level& coarse, const Level& fine);
    static void prolong(Level& fine, const Level& coarse);

    std::vector<Level> levels_;
};

}  // namespace spindrift::cpu
