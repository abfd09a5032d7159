// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/number.h"
#include "core/poisson_levels.h"

namespace spindrift
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

/// Solves A x = b, A = -div grad (core/poisson.h), in double. Implementations: cpu::PoissonSolver,
/// gpu::PoissonSolver; they give the same bits. Every connected part of the problem must touch a border of
/// value zero.
class PoissonSolver
{
  public:
    virtual ~PoissonSolver() = default;

    /// Layout of b and x.
    virtual const PaddedBox& box() const = 0;
    /// On the host.
    virtual FaceCoefficients coefficients() const = 0;

    /// b: outflow of each cell (its integral, not per volume); zero in the border and in walls. x: any size.
    PoissonResult solve(const std::vector<double>& b, std::vector<double>& x, const PoissonSettings& settings)
    {
        const double size_of_b = sqrt(begin(b));
        PoissonResult result{0, 0, true};
        if (size_of_b > 0)
            result = settings.method == PoissonMethod::multigrid ? conjugate_gradients(settings, size_of_b)
                                                                 : relax(settings, size_of_b);
        end(x);
        return result;
    }

  protected:
    // The steps of both methods; sums by RowChunks. r is the residual, p the direction, z a cycle's result.

    /// x = 0, r = b, p = 0; returns b.b. `b` stays until end().
    virtual double begin(const std::vector<double>& b) = 0;
    /// z = cycle(scale r); returns r.z. The scale keeps single precision in its range.
    virtual double precondition(double scale) = 0;
    /// p = z + beta p; returns p.A p.
    virtual double turn(double beta) = 0;
    /// x = x + alpha p, r = r - alpha A p; returns r.r.
    virtual double advance(double alpha) = 0;
    /// So many red-black sweeps of x, r = b - A x; returns r.r.
    virtual double sweep(int sweeps, double factor) = 0;
    /// Of r.
    virtual double largest_per_volume() const = 0;
    virtual void end(std::vector<double>& x) = 0;

  private:
    /// Sweeps of the relaxation between two looks at its residual.
    static constexpr int kSweepsPerLook = 8;

    PoissonResult conjugate_gradients(const PoissonSettings& settings, double size_of_b)
    {
        PoissonResult result{0, 1, false};
        const double scale = 1 / size_of_b;
        double rz = precondition(scale), beta = 0;
        while (result.iterations < settings.most_iterations && rz > 0)
        {
            const double curvature = turn(beta);
            if (!(curvature > 0)) break;
            const double rr = advance(rz / curvature);
            if (look(settings, sqrt(rr) / size_of_b, 1, result)) break;
            const double next = precondition(scale);
            beta = next / rz;
            rz = next;
        }
        return result;
    }

    PoissonResult relax(const PoissonSettings& settings, double size_of_b)
    {
        PoissonResult result{0, 1, false};
        while (result.iterations < settings.most_iterations)
        {
            const double rr = sweep(kSweepsPerLook, settings.over_relaxation);
            if (look(settings, sqrt(rr) / size_of_b, kSweepsPerLook, result)) break;
        }
        return result;
    }

    /// After `more` iterations: whether that is enough.
    bool look(const PoissonSettings& settings, double relative, int more, PoissonResult& result) const
    {
        result.iterations += more;
        result.relative_residual = relative;
        if (settings.progress) settings.progress(result.iterations, relative);
        result.converged =
            relative <= settings.tolerance &&
            (settings.largest_residual <= 0 || largest_per_volume() <= settings.largest_residual);
        return result.converged;
    }
};

/// Makes a solver on some backend.
using PoissonSolverMaker = std::function<std::unique_ptr<PoissonSolver>(const PoissonProblem&)>;

}  // namespace spindrift
