// SPDX-License-Identifier: MIT
// The solver of the wind on a field whose answer is known: the error must fall with the square of the cell.
// Docs: docs/validation.md.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "cpu/poisson_solver.h"
#include "validation/all_cases.h"
#include "validation/manufactured.h"

namespace spindrift::validation
{

namespace
{

/// Thicknesses of n layers over a height of 0.8, the highest exp(stretch) times as thick as the lowest.
std::vector<double> layers(int n, double stretch)
{
    const auto height = [&](double share)
    { return stretch == 0 ? 0.8 * share : 0.8 * std::expm1(stretch * share) / std::expm1(stretch); };
    std::vector<double> result;
    for (int k = 0; k < n; ++k) result.push_back(height((k + 1.0) / n) - height(static_cast<double>(k) / n));
    return result;
}

}  // namespace

Manufactured::Manufactured(int n, double stretch)
{
    problem.side_m[0].assign(static_cast<std::size_t>(n), 1.0 / n);
    problem.side_m[1].assign(static_cast<std::size_t>(n + 1), 1.5 / (n + 1));
    problem.side_m[2] = layers(n - 1, stretch);
    problem.part.assign(
        static_cast<std::size_t>(n) * static_cast<std::size_t>(n + 1) * static_cast<std::size_t>(n - 1), 1);
    problem.zero_border = {true, true, true, true, false, true};
    const PaddedBox at = box();
    b.assign(static_cast<std::size_t>(at.count()), 0);
    truth = b;
    constexpr double kPi = std::numbers::pi;
    const double k2 = kPi * kPi * (1 + 1 / 2.25 + 1 / 2.56);
    double low = 0;
    for (int z = 0; z < at.nz; ++z)
    {
        const double dz = problem.side_m[2][static_cast<std::size_t>(z)], middle = low + 0.5 * dz;
        low += dz;
        for (int j = 0; j < at.ny; ++j)
            for (int i = 0; i < at.nx; ++i)
            {
                const double value = std::sin(kPi * (i + 0.5) / at.nx) * std::sin(kPi * (j + 0.5) / at.ny) *
                                     std::cos(kPi * middle / 1.6);
                truth[static_cast<std::size_t>(at.index(i, j, z))] = value;
                b[static_cast<std::size_t>(at.index(i, j, z))] = k2 * value * dz * 1.5 / (at.nx * at.ny);
            }
    }
}

PaddedBox Manufactured::box() const
{
    return {static_cast<int>(problem.side_m[0].size()), static_cast<int>(problem.side_m[1].size()),
            static_cast<int>(problem.side_m[2].size())};
}

double Manufactured::error(const std::vector<double>& x) const
{
    const PaddedBox at = box();
    double sum = 0;
    for (int z = 0; z < at.nz; ++z)
        for (int j = 0; j < at.ny; ++j)
            for (int i = 0; i < at.nx; ++i)
            {
                const auto c = static_cast<std::size_t>(at.index(i, j, z));
                sum += (x[c] - truth[c]) * (x[c] - truth[c]) *
                       problem.side_m[2][static_cast<std::size_t>(z)] / 0.8 / (at.nx * at.ny);
            }
    return std::sqrt(sum);
}

Outcome validate_solver_order(const Settings&)
{
    Outcome outcome;
    for (const double stretch : {0.0, 1.5, 3.0})
    {
        double before = 0;
        for (const int n : {16, 32, 64})
        {
            const Manufactured field(n, stretch);
            std::vector<double> x;
            PoissonSettings settings;
            settings.tolerance = 1e-10;
            const PoissonResult done = cpu::PoissonSolver(field.problem).solve(field.b, x, settings);
            const double error = field.error(x);
            const std::string which = fmt::format("layers stretched by exp {:g}, {} cells: ", stretch, n);
            outcome.checks.push_back(at_most(which + "relative residual", done.relative_residual, 1e-10));
            if (before > 0)
                outcome.checks.push_back(
                    {which + "order over half the cells", std::log2(before / error), 2, 0, 0.3});
            before = error;
        }
    }
    return outcome;
}

}  // namespace spindrift::validation
