// SPDX-License-Identifier: MIT
#include "cpu/wind_projection.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.h"
#include "cpu/rows.h"

namespace spindrift::cpu
{

namespace
{

/// Largest |div u| left, in U / h.
constexpr double kTolerance = 1e-6;

/// Fluid cells that the border air can reach; the unknowns.
std::vector<std::uint8_t> open_cells(const StaggeredWind& wind)
{
    const GridSize n = wind.size;
    std::vector<std::uint8_t> open(n.count(), 0);
    std::vector<std::size_t> stack;
    const auto enter = [&](std::size_t i)
    {
        if (wind.solid[i] != 0 || open[i] != 0) return;
        open[i] = 1;
        stack.push_back(i);
    };
    for (int z = 0; z < n.nz; ++z)
        for (int y = 0; y < n.ny; ++y)
            for (int x = 0; x < n.nx; ++x)
                if (x == 0 || x == n.nx - 1 || y == 0 || y == n.ny - 1 || z == n.nz - 1)
                    enter(n.index(x, y, z));
    const auto nx = static_cast<std::size_t>(n.nx), ny = static_cast<std::size_t>(n.ny),
               nz = static_cast<std::size_t>(n.nz);
    while (!stack.empty())
    {
        const std::size_t i = stack.back();
        stack.pop_back();
        const std::size_t x = i % nx, y = i / nx % ny, z = i / nx / ny;
        if (x > 0) enter(i - 1);
        if (x + 1 < nx) enter(i + 1);
        if (y > 0) enter(i - nx);
        if (y + 1 < ny) enter(i + nx);
        if (z > 0) enter(i - nx * ny);
        if (z + 1 < nz) enter(i + nx * ny);
    }
    return open;
}

/// A wind and the Poisson equation of its projection.
class Projector
{
  public:
    Projector(StaggeredWind& wind, const PoissonSolverMaker& make_solver)
        : wind_(wind),
          make_solver_(make_solver),
          open_(open_cells(wind)),
          layout_{wind.size.nx, wind.size.ny, wind.size.nz}
    {
        close_faces();
    }

    /// Outflow of each open cell (m3/s) in `result`; returns the largest |divergence|, 1/s.
    double largest_divergence(std::vector<double>& result) const
    {
        result.assign(static_cast<std::size_t>(layout_.count()), 0);
        return fold_rows(
            layout_,
            [&](std::ptrdiff_t first, int y, int z)
            {
                const double volume = wind_.cell_m.x * wind_.cell_m.y * wind_.layer_m[z];
                double most = 0;
                for (int x = 0; x < layout_.nx; ++x)
                {
                    if (open_[wind_.size.index(x, y, z)] == 0) continue;
                    const double divergence = wind_.divergence(x, y, z);
                    result[first + x] = divergence * volume;
                    most = std::max(most, std::abs(divergence));
                }
                return most;
            },
            [](double a, double b) { return std::max(a, b); });
    }

    spindrift::PoissonSolver& solver()
    {
        if (!solver_)
            solver_ = make_solver_ ? make_solver_(problem()) : std::make_unique<PoissonSolver>(problem());
        return *solver_;
    }

    /// u += grad lambda on every face between open cells and on the open border.
    void correct(const std::vector<double>& lambda)
    {
        const FaceCoefficients c = solver().coefficients();
        const double area_xy = wind_.cell_m.x * wind_.cell_m.y;
        // faces across x belong to the row of the cell above them; so do those of y and z
        for_each_row(
            layout_,
            [&](std::ptrdiff_t first, int y, int z)
            {
                const double area_x = wind_.cell_m.y * wind_.layer_m[z],
                             area_y = wind_.cell_m.x * wind_.layer_m[z];
                const auto flow = [&](const float* f, std::ptrdiff_t lower, std::ptrdiff_t step)
                { return static_cast<double>(f[lower]) * (lambda[lower + step] - lambda[lower]); };
                for (int x = 0; x <= layout_.nx; ++x)
                    wind_.u[wind_.u_size().index(x, y, z)] += flow(c.x, first + x - 1, 1) / area_x;
                for (int x = 0; x < layout_.nx; ++x)
                {
                    const std::ptrdiff_t i = first + x;
                    wind_.v[wind_.v_size().index(x, y, z)] += flow(c.y, i - c.row, c.row) / area_y;
                    wind_.w[wind_.w_size().index(x, y, z)] += flow(c.z, i - c.plane, c.plane) / area_xy;
                    if (y + 1 == layout_.ny)
                        wind_.v[wind_.v_size().index(x, y + 1, z)] += flow(c.y, i, c.row) / area_y;
                    if (z + 1 == layout_.nz)
                        wind_.w[wind_.w_size().index(x, y, z + 1)] += flow(c.z, i, c.plane) / area_xy;
                }
            });
    }

  private:
    PoissonProblem problem() const
    {
        PoissonProblem problem;
        problem.side_m[0].assign(static_cast<std::size_t>(layout_.nx), wind_.cell_m.x);
        problem.side_m[1].assign(static_cast<std::size_t>(layout_.ny), wind_.cell_m.y);
        problem.side_m[2] = wind_.layer_m;
        problem.part = open_;
        problem.zero_border = {true, true, true, true, false, true};
        return problem;
    }

    /// No flow through the ground, nor through any face of a cell that is not open.
    void close_faces()
    {
        const GridSize n = wind_.size;
        std::fill_n(wind_.w.begin(), static_cast<std::ptrdiff_t>(n.nx) * n.ny, 0.0);
        std::size_t i = 0;
        for (int z = 0; z < n.nz; ++z)
            for (int y = 0; y < n.ny; ++y)
                for (int x = 0; x < n.nx; ++x, ++i)
                {
                    if (open_[i] != 0) continue;
                    for (int upper = 0; upper < 2; ++upper)
                    {
                        wind_.u[wind_.u_size().index(x + upper, y, z)] = 0;
                        wind_.v[wind_.v_size().index(x, y + upper, z)] = 0;
                        wind_.w[wind_.w_size().index(x, y, z + upper)] = 0;
                    }
                }
    }

    StaggeredWind& wind_;
    const PoissonSolverMaker& make_solver_;
    std::vector<std::uint8_t> open_;
    PaddedBox layout_;
    std::unique_ptr<spindrift::PoissonSolver> solver_;
};

double largest_speed(const StaggeredWind& wind)
{
    double most = 0;
    for (const auto* faces : {&wind.u, &wind.v, &wind.w})
        for (const double v : *faces) most = std::max(most, std::abs(v));
    return most;
}

Projection project(StaggeredWind& wind, const PoissonSettings& wanted, const PoissonSolverMaker& make_solver)
{
    Projection result;
    Projector projector(wind, make_solver);
    const double goal =
        kTolerance * largest_speed(wind) / std::min({wind.cell_m.x, wind.cell_m.y, wind.cell_m.z});
    std::vector<double> outflow, lambda;
    result.before_per_s = projector.largest_divergence(outflow);
    result.after_per_s = result.before_per_s;
    PoissonSettings settings = wanted;
    settings.largest_residual = 0.5 * goal;
    // the recursive residual drifts from the true one by rounding: look, and go on if need be
    for (int round = 0; round < 3 && result.after_per_s > goal; ++round)
    {
        const PoissonResult done = projector.solver().solve(outflow, lambda, settings);
        result.iterations += done.iterations;
        if (round == 0) result.relative_residual = done.relative_residual;
        projector.correct(lambda);
        result.after_per_s = projector.largest_divergence(outflow);
        settings.tolerance = 0.5;  // of a residual that is already small
    }
    if (!(result.after_per_s <= goal))
        throw Error(fmt::format(
            "the wind around the solids did not converge in {} iterations (divergence {:.3g} 1/s, goal "
            "{:.3g}); use larger wind cells",
            result.iterations, result.after_per_s, goal));
    return result;
}

}  // namespace

Projection make_divergence_free(StaggeredWind& wind, const ProjectionSettings& settings)
{
    if (settings.threads == 0) return project(wind, settings.solver, settings.make_solver);
    Projection result;
    tbb::task_arena(settings.threads)
        .execute([&] { result = project(wind, settings.solver, settings.make_solver); });
    return result;
}

}  // namespace spindrift::cpu
