// SPDX-License-Identifier: MIT
#include "cpu/poisson_solver.h"

#include <algorithm>
#include <cmath>

#include "cpu/rows.h"

namespace spindrift::cpu
{

namespace
{

/// Sweeps of the relaxation between two looks at its residual.
constexpr int kSweepsPerLook = 8;

}  // namespace

PoissonSolver::PoissonSolver(const PoissonProblem& problem) : side_m_(problem.side_m), multigrid_(problem) {}

double PoissonSolver::norm(const std::vector<double>& v) const
{
    const int nx = box().nx;
    return std::sqrt(sum_rows(box(),
                              [&](std::ptrdiff_t first, int, int)
                              {
                                  const double* row = v.data() + first;
                                  return sum_of(nx, [&](int i) { return row[i] * row[i]; });
                              }));
}

double PoissonSolver::largest_per_volume(const std::vector<double>& r) const
{
    return fold_rows(
        box(),
        [&](std::ptrdiff_t first, int y, int z)
        {
            double most = 0;
            for (int x = 0; x < box().nx; ++x) most = std::max(most, std::abs(r[first + x]) / side_m_[0][x]);
            return most / (side_m_[1][y] * side_m_[2][z]);
        },
        [](double a, double b) { return std::max(a, b); });
}

bool PoissonSolver::small_enough(const PoissonSettings& settings, double relative,
                                 const std::vector<double>& r) const
{
    return relative <= settings.tolerance &&
           (settings.largest_residual <= 0 || largest_per_volume(r) <= settings.largest_residual);
}

PoissonResult PoissonSolver::solve(const std::vector<double>& b, std::vector<double>& x,
                                   const PoissonSettings& settings)
{
    x.assign(static_cast<std::size_t>(box().count()), 0);
    const double size_of_b = norm(b);
    if (!(size_of_b > 0)) return {0, 0, true};
    return settings.method == PoissonMethod::multigrid ? conjugate_gradients(b, x, settings, size_of_b)
                                                       : relax(b, x, settings, size_of_b);
}

/// Result of a cycle for scale * r in multigrid_.result(); returns its product with r. The scale keeps single
/// precision in its range.
double PoissonSolver::precondition(const std::vector<double>& r, double scale)
{
    const int nx = box().nx;
    float* to = multigrid_.right_hand_side();
    for_each_row(box(),
                 [&](std::ptrdiff_t first, int, int)
                 {
                     for (std::ptrdiff_t i = first; i < first + nx; ++i)
                         to[i] = static_cast<float>(r[i] * scale);
                 });
    multigrid_.cycle();
    const float* z = multigrid_.result();
    return sum_rows(box(),
                    [&](std::ptrdiff_t first, int, int)
                    {
                        const double* a = r.data() + first;
                        const float* c = z + first;
                        return sum_of(nx, [&](int i) { return a[i] * static_cast<double>(c[i]); });
                    });
}

PoissonResult PoissonSolver::conjugate_gradients(const std::vector<double>& b, std::vector<double>& x,
                                                 const PoissonSettings& settings, double size_of_b)
{
    const PaddedBox& n = box();
    const FaceCoefficients c = coefficients();
    std::vector<double> r = b, p(b.size(), 0), image(b.size(), 0);
    const float* z = multigrid_.result();
    const double scale = 1 / size_of_b;
    PoissonResult result{0, 1, false};
    double rz = precondition(r, scale), beta = 0;
    while (result.iterations < settings.most_iterations && rz > 0)
    {
        for_each_row(n,
                     [&](std::ptrdiff_t first, int, int)
                     {
                         for (std::ptrdiff_t i = first; i < first + n.nx; ++i)
                             p[i] = static_cast<double>(z[i]) + beta * p[i];
                     });
        const double curvature = sum_rows(n,
                                          [&](std::ptrdiff_t first, int, int)
                                          {
                                              double* const to = image.data() + first;
                                              const double* const from = p.data() + first;
                                              for (int i = 0; i < n.nx; ++i)
                                                  to[i] = c.outflow(p.data(), first + i);
                                              return sum_of(n.nx, [&](int i) { return to[i] * from[i]; });
                                          });
        if (!(curvature > 0)) break;
        const double alpha = rz / curvature;
        const double rr = sum_rows(n,
                                   [&](std::ptrdiff_t first, int, int)
                                   {
                                       double *xs = x.data() + first, *rs = r.data() + first;
                                       const double *ps = p.data() + first, *as = image.data() + first;
                                       for (int i = 0; i < n.nx; ++i) xs[i] += alpha * ps[i];
                                       for (int i = 0; i < n.nx; ++i) rs[i] -= alpha * as[i];
                                       return sum_of(n.nx, [&](int i) { return rs[i] * rs[i]; });
                                   });
        ++result.iterations;
        result.relative_residual = std::sqrt(rr) / size_of_b;
        if (settings.progress) settings.progress(result.iterations, result.relative_residual);
        result.converged = small_enough(settings, result.relative_residual, r);
        if (result.converged) break;
        const double next = precondition(r, scale);
        beta = next / rz;
        rz = next;
    }
    return result;
}

PoissonResult PoissonSolver::relax(const std::vector<double>& b, std::vector<double>& x,
                                   const PoissonSettings& settings, double size_of_b)
{
    const PaddedBox& n = box();
    const FaceCoefficients c = coefficients();
    const float* inverse = multigrid_.inverse_diagonal();
    const Smoother<double> smoother{c, inverse, b.data(), x.data(), settings.over_relaxation};
    std::vector<double> r(b.size(), 0);
    const ResidualTaker<double> taker{c, inverse, b.data(), x.data(), r.data()};
    PoissonResult result{0, 1, false};
    while (result.iterations < settings.most_iterations && !result.converged)
    {
        for (int sweep = 0; sweep < kSweepsPerLook; ++sweep)
            for (const int colour : {0, 1})
                for_each_row(n,
                             [&](std::ptrdiff_t first, int y, int z)
                             {
                                 for (int i = (y + z + colour) & 1; i < n.nx; i += 2) smoother(first + i);
                             });
        result.iterations += kSweepsPerLook;
        for_each_row(n,
                     [&](std::ptrdiff_t first, int, int)
                     {
                         for (std::ptrdiff_t i = first; i < first + n.nx; ++i) taker(i);
                     });
        result.relative_residual = norm(r) / size_of_b;
        if (settings.progress) settings.progress(result.iterations, result.relative_residual);
        result.converged = small_enough(settings, result.relative_residual, r);
    }
    return result;
}

}  // namespace spindrift::cpu
