// SPDX-License-Identifier: MIT
#include "cpu/poisson_solver.h"

#include <algorithm>
#include <utility>

#include "cpu/rows.h"

namespace spindrift::cpu
{

namespace
{

double sum_of_squares(const PaddedBox& box, const std::vector<double>& v)
{
    return sum_rows(box,
                    [&](std::ptrdiff_t first, int, int)
                    {
                        const double* row = v.data() + first;
                        return sum_of(box.nx, [&](int i) { return row[i] * row[i]; });
                    });
}

}  // namespace

PoissonSolver::PoissonSolver(const PoissonProblem& problem) : side_m_(problem.side_m), multigrid_(problem) {}

double PoissonSolver::begin(const std::vector<double>& b)
{
    b_ = &b;
    r_ = b;
    for (auto* array : {&x_, &p_, &image_}) array->assign(b.size(), 0);
    return sum_of_squares(box(), b);
}

double PoissonSolver::precondition(double scale)
{
    const int nx = box().nx;
    float* to = multigrid_.right_hand_side();
    for_each_row(box(),
                 [&](std::ptrdiff_t first, int, int)
                 {
                     for (std::ptrdiff_t i = first; i < first + nx; ++i)
                         to[i] = static_cast<float>(r_[i] * scale);
                 });
    multigrid_.cycle();
    const float* z = multigrid_.result();
    return sum_rows(box(),
                    [&](std::ptrdiff_t first, int, int)
                    {
                        const double* a = r_.data() + first;
                        const float* c = z + first;
                        return sum_of(nx, [&](int i) { return a[i] * static_cast<double>(c[i]); });
                    });
}

double PoissonSolver::turn(double beta)
{
    const int nx = box().nx;
    const FaceCoefficients c = coefficients();
    const float* z = multigrid_.result();
    for_each_row(box(),
                 [&](std::ptrdiff_t first, int, int)
                 {
                     for (std::ptrdiff_t i = first; i < first + nx; ++i)
                         p_[i] = static_cast<double>(z[i]) + beta * p_[i];
                 });
    return sum_rows(box(),
                    [&](std::ptrdiff_t first, int, int)
                    {
                        double* const to = image_.data() + first;
                        const double* const from = p_.data() + first;
                        for (int i = 0; i < nx; ++i) to[i] = c.outflow(p_.data(), first + i);
                        return sum_of(nx, [&](int i) { return to[i] * from[i]; });
                    });
}

double PoissonSolver::advance(double alpha)
{
    const int nx = box().nx;
    return sum_rows(box(),
                    [&](std::ptrdiff_t first, int, int)
                    {
                        double *x = x_.data() + first, *r = r_.data() + first;
                        const double *p = p_.data() + first, *image = image_.data() + first;
                        for (int i = 0; i < nx; ++i) x[i] += alpha * p[i];
                        for (int i = 0; i < nx; ++i) r[i] -= alpha * image[i];
                        return sum_of(nx, [&](int i) { return r[i] * r[i]; });
                    });
}

double PoissonSolver::sweep(int sweeps, double factor)
{
    const int nx = box().nx;
    const FaceCoefficients c = coefficients();
    const float* inverse = multigrid_.inverse_diagonal();
    const Smoother<double> smoother{c, inverse, b_->data(), x_.data(), factor};
    const ResidualTaker<double> taker{c, inverse, b_->data(), x_.data(), r_.data()};
    for (int done = 0; done < sweeps; ++done)
        for (const int colour : {0, 1})
            for_each_row(box(),
                         [&](std::ptrdiff_t first, int y, int z)
                         {
                             for (int i = (y + z + colour) & 1; i < nx; i += 2) smoother(first + i);
                         });
    for_each_row(box(),
                 [&](std::ptrdiff_t first, int, int)
                 {
                     for (std::ptrdiff_t i = first; i < first + nx; ++i) taker(i);
                 });
    return sum_of_squares(box(), r_);
}

double PoissonSolver::largest_per_volume() const
{
    const LargestPerVolume of_row{box(), side_m_[0].data(), side_m_[1].data(), side_m_[2].data(), r_.data()};
    return fold_rows(
        box(), [&](std::ptrdiff_t, int y, int z) { return of_row(y, z); },
        [](double a, double b) { return std::max(a, b); });
}

void PoissonSolver::end(std::vector<double>& x)
{
    x = std::move(x_);
}

}  // namespace spindrift::cpu
