// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "core/poisson_solver.h"
#include "cpu/multigrid.h"

namespace spindrift::cpu
{

/// On the threads of the current arena; the result does not depend on their number.
class PoissonSolver final : public spindrift::PoissonSolver
{
  public:
    explicit PoissonSolver(const PoissonProblem& problem);

    const PaddedBox& box() const override { return multigrid_.box(); }
    FaceCoefficients coefficients() const override { return multigrid_.coefficients(); }
    std::size_t levels() const { return multigrid_.levels(); }

  private:
    double begin(const std::vector<double>& b) override;
    double precondition(double scale) override;
    double turn(double beta) override;
    double advance(double alpha) override;
    double sweep(int sweeps, double factor) override;
    double largest_per_volume() const override;
    void end(std::vector<double>& x) override;

    std::array<std::vector<double>, 3> side_m_;
    Multigrid multigrid_;
    const std::vector<double>* b_ = nullptr;
    std::vector<double> x_, r_, p_, image_;  ///< image: A p
};

}  // namespace spindrift::cpu
