// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "cpu/multigrid.h"

namespace spindrift::cpu
{

enum class PoissonMethod
{
    multigrid,        ///< conjugate gradients, preconditioned by a V-cycle
    over_relaxation,  ///< red-black, the classical one; for comparison
};

struct PoissonSettings
{
    PoissonMethod method = PoissonMethod::multigrid;
    double tolerance = 1e-6;      ///< of |b - A x| over |b|, both L2
    double largest_residual = 0;  ///< > 0: also of |b - A x| in any cell, per volume
    int most_iterations = 20000;
    double over_relaxation = 1.78;
    std::function<void(int, double)> progress;  ///< iteration, relative residual
};

struct PoissonResult
{
    int iterations = 0;
    double relative_residual = 0;
    bool converged = false;
};

/// Solves A x = b, A = -div grad (core/poisson.h), in double. The result does not depend on the number of
/// threads. Every connected part of the problem must touch a border of value zero.
class PoissonSolver
{
  public:
    explicit PoissonSolver(const PoissonProblem& problem);

    /// Layout of b and x.
    const PaddedBox& box() const { return multigrid_.box(); }
    FaceCoefficients coefficients() const { return multigrid_.coefficients(); }
    std::size_t levels() const { return multigrid_.levels(); }

    /// b: outflow of each cell (its integral, not per volume); zero in the border and in walls. x: any size.
    PoissonResult solve(const std::vector<double>& b, std::vector<double>& x,
                        const PoissonSettings& settings);

  private:
    PoissonResult conjugate_gradients(const std::vector<double>& b, std::vector<double>& x,
                                      const PoissonSettings& settings, double size_of_b);
    PoissonResult relax(const std::vector<double>& b, std::vector<double>& x, const PoissonSettings& settings,
                        double size_of_b);
    double precondition(const std::vector<double>& r, double scale);
    double largest_per_volume(const std::vector<double>& r) const;
    double norm(const std::vector<double>& v) const;
    bool small_enough(const PoissonSettings& settings, double relative, const std::vector<double>& r) const;

    std::array<std::vector<double>, 3> side_m_;
    Multigrid multigrid_;
};

}  // namespace spindrift::cpu
