// SPDX-License-Identifier: MIT
#include "scene/staggered_wind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace spindrift::scene
{

namespace
{

constexpr double kTolerance = 1e-6;
constexpr int kMostIterations = 4000;

/// Fluid cells that the border air can reach; the unknowns.
std::vector<std::uint8_t> open_cells(const StaggeredWind& wind)
{
    const GridSize n = wind.size;
    std::vector<std::uint8_t> open(n.count(), 0);
    std::vector<std::size_t> stack;
    const auto enter = [&](int x, int y, int z)
    {
        const std::size_t i = n.index(x, y, z);
        if (wind.solid[i] != 0 || open[i] != 0) return;
        open[i] = 1;
        stack.push_back(i);
    };
    for (int z = 0; z < n.nz; ++z)
        for (int y = 0; y < n.ny; ++y)
            for (int x = 0; x < n.nx; ++x)
                if (x == 0 || x == n.nx - 1 || y == 0 || y == n.ny - 1 || z == n.nz - 1) enter(x, y, z);
    const auto nx = static_cast<std::size_t>(n.nx), ny = static_cast<std::size_t>(n.ny);
    while (!stack.empty())
    {
        const std::size_t i = stack.back();
        stack.pop_back();
        const int x = static_cast<int>(i % nx), y = static_cast<int>(i / nx % ny),
                  z = static_cast<int>(i / nx / ny);
        if (x > 0) enter(x - 1, y, z);
        if (x + 1 < n.nx) enter(x + 1, y, z);
        if (y > 0) enter(x, y - 1, z);
        if (y + 1 < n.ny) enter(x, y + 1, z);
        if (z > 0) enter(x, y, z - 1);
        if (z + 1 < n.nz) enter(x, y, z + 1);
    }
    return open;
}

/// A lambda = div u with A = -Laplace over the open cells, and the faces that it acts on.
class Poisson
{
  public:
    explicit Poisson(StaggeredWind& wind)
        : wind_(wind),
          n_(wind.size),
          open_(open_cells(wind)),
          step_{1, static_cast<std::size_t>(n_.nx),
                static_cast<std::size_t>(n_.nx) * static_cast<std::size_t>(n_.ny)}
    {
        close_faces();
        diagonal_.assign(n_.count(), 0);
        for (auto& c : coupling_) c.assign(n_.count(), 0);
        const double weight[3] = {1 / (wind.cell_m.x * wind.cell_m.x), 1 / (wind.cell_m.y * wind.cell_m.y),
                                  1 / (wind.cell_m.z * wind.cell_m.z)};
        each_cell([&](std::size_t i, int x, int y, int z) { set_row(i, x, y, z, weight); });
        factorise();
    }

    double largest_divergence(std::vector<double>& result) const
    {
        double largest = 0;
        result.assign(n_.count(), 0);
        each_cell(
            [&](std::size_t i, int x, int y, int z)
            {
                result[i] = wind_.divergence(x, y, z);
                largest = std::max(largest, std::abs(result[i]));
            });
        return largest;
    }

    /// Conjugate gradients until no |residual| is above `goal`; returns the iterations.
    int solve(std::vector<double>& residual, double goal, std::vector<double>& lambda) const
    {
        lambda.assign(n_.count(), 0);
        std::vector<double> z(n_.count(), 0), direction, image(n_.count(), 0);
        precondition(residual, z);
        direction = z;
        double rz = product(residual, z);
        for (int iteration = 0; iteration < kMostIterations; ++iteration)
        {
            if (largest(residual) <= goal || !(rz > 0)) return iteration;
            apply(direction, image);
            const double alpha = rz / product(direction, image);
            for (std::size_t i = 0; i < lambda.size(); ++i)
            {
                lambda[i] += alpha * direction[i];
                residual[i] -= alpha * image[i];
            }
            precondition(residual, z);
            const double next = product(residual, z);
            const double beta = next / rz;
            rz = next;
            for (std::size_t i = 0; i < z.size(); ++i) direction[i] = z[i] + beta * direction[i];
        }
        return kMostIterations;
    }

    /// u += grad lambda on every face between open cells and on the open border.
    void correct(const std::vector<double>& lambda)
    {
        each_cell(
            [&](std::size_t i, int x, int y, int z)
            {
                const int at[3] = {x, y, z};
                for (int a = 0; a < 3; ++a)
                {
                    const double per = 1 / side(a);
                    if (at[a] == 0 ? a < 2 : open_[i - step_[a]] != 0)
                        face(a, x, y, z, 0) += (lambda[i] - (at[a] == 0 ? 0 : lambda[i - step_[a]])) * per;
                    if (at[a] + 1 == count(a)) face(a, x, y, z, 1) -= lambda[i] * per;
                }
            });
    }

  private:
    double side(int axis) const
    {
        return axis == 0 ? wind_.cell_m.x : axis == 1 ? wind_.cell_m.y : wind_.cell_m.z;
    }
    int count(int axis) const { return axis == 0 ? n_.nx : axis == 1 ? n_.ny : n_.nz; }

    /// The lower (0) or upper (1) face of a cell across an axis.
    double& face(int axis, int x, int y, int z, int upper)
    {
        if (axis == 0) return wind_.u[wind_.u_size().index(x + upper, y, z)];
        if (axis == 1) return wind_.v[wind_.v_size().index(x, y + upper, z)];
        return wind_.w[wind_.w_size().index(x, y, z + upper)];
    }

    template <class Visit>
    void each_cell(Visit visit) const
    {
        std::size_t i = 0;
        for (int z = 0; z < n_.nz; ++z)
            for (int y = 0; y < n_.ny; ++y)
                for (int x = 0; x < n_.nx; ++x, ++i)
                    if (open_[i] != 0) visit(i, x, y, z);
    }

    /// No flow through the ground, nor through any face of a cell that is not open.
    void close_faces()
    {
        std::size_t i = 0;
        for (int z = 0; z < n_.nz; ++z)
            for (int y = 0; y < n_.ny; ++y)
                for (int x = 0; x < n_.nx; ++x, ++i)
                {
                    if (z == 0) face(2, x, y, z, 0) = 0;
                    if (open_[i] != 0) continue;
                    for (int a = 0; a < 3; ++a) face(a, x, y, z, 0) = face(a, x, y, z, 1) = 0;
                }
    }

    void set_row(std::size_t i, int x, int y, int z, const double (&weight)[3])
    {
        const int at[3] = {x, y, z};
        for (int a = 0; a < 3; ++a)
        {
            const bool low_border = at[a] == 0, high_border = at[a] + 1 == count(a);
            if (low_border ? a < 2 : open_[i - step_[a]] != 0) diagonal_[i] += weight[a];
            if (high_border || open_[i + step_[a]] != 0) diagonal_[i] += weight[a];
            if (!high_border && open_[i + step_[a]] != 0) coupling_[a][i] = -weight[a];
        }
    }

    /// MIC(0) as Bridson, "Fluid Simulation for Computer Graphics", section 5.5 gives it.
    void factorise()
    {
        constexpr double kTuning = 0.97, kSafety = 0.25;
        scale_.assign(n_.count(), 0);
        each_cell(
            [&](std::size_t i, int x, int y, int z)
            {
                const int at[3] = {x, y, z};
                double e = diagonal_[i];
                for (int a = 0; a < 3; ++a)
                {
                    if (at[a] == 0) continue;
                    const std::size_t j = i - step_[a];
                    const double c = coupling_[a][j] * scale_[j];
                    const double others = coupling_[(a + 1) % 3][j] + coupling_[(a + 2) % 3][j];
                    e -= c * c + kTuning * c * others * scale_[j];
                }
                if (e < kSafety * diagonal_[i]) e = diagonal_[i];
                scale_[i] = e > 0 ? 1 / std::sqrt(e) : 0;
            });
    }

    void precondition(const std::vector<double>& r, std::vector<double>& z) const
    {
        for (std::size_t i = 0; i < r.size(); ++i)
        {
            if (open_[i] == 0) continue;
            double t = r[i];
            for (int a = 0; a < 3; ++a)
                if (i >= step_[a]) t -= coupling_[a][i - step_[a]] * scale_[i - step_[a]] * z[i - step_[a]];
            z[i] = t * scale_[i];
        }
        for (std::size_t i = r.size(); i-- > 0;)
        {
            if (open_[i] == 0) continue;
            double t = z[i];
            for (int a = 0; a < 3; ++a)
                if (i + step_[a] < r.size()) t -= coupling_[a][i] * scale_[i] * z[i + step_[a]];
            z[i] = t * scale_[i];
        }
    }

    void apply(const std::vector<double>& x, std::vector<double>& result) const
    {
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            double sum = diagonal_[i] * x[i];
            for (int a = 0; a < 3; ++a)
            {
                if (i + step_[a] < x.size()) sum += coupling_[a][i] * x[i + step_[a]];
                if (i >= step_[a]) sum += coupling_[a][i - step_[a]] * x[i - step_[a]];
            }
            result[i] = sum;
        }
    }

    static double product(const std::vector<double>& a, const std::vector<double>& b)
    {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
        return sum;
    }

    static double largest(const std::vector<double>& values)
    {
        double most = 0;
        for (const double v : values) most = std::max(most, std::abs(v));
        return most;
    }

    StaggeredWind& wind_;
    GridSize n_;
    std::vector<std::uint8_t> open_;
    std::size_t step_[3];
    std::vector<double> diagonal_, scale_;
    std::vector<double> coupling_[3];  ///< to the upper neighbour along each axis; 0 where there is none
};

double largest_speed(const StaggeredWind& wind)
{
    double most = 0;
    for (const auto* faces : {&wind.u, &wind.v, &wind.w})
        for (const double v : *faces) most = std::max(most, std::abs(v));
    return most;
}

}  // namespace

StaggeredWind::StaggeredWind(GridSize grid, Vec3d cell) : size(grid), cell_m(cell)
{
    u.assign(u_size().count(), 0);
    v.assign(v_size().count(), 0);
    w.assign(w_size().count(), 0);
    solid.assign(size.count(), 0);
}

double StaggeredWind::divergence(int x, int y, int z) const
{
    return (u[u_size().index(x + 1, y, z)] - u[u_size().index(x, y, z)]) / cell_m.x +
           (v[v_size().index(x, y + 1, z)] - v[v_size().index(x, y, z)]) / cell_m.y +
           (w[w_size().index(x, y, z + 1)] - w[w_size().index(x, y, z)]) / cell_m.z;
}

Vec3f StaggeredWind::centre(int x, int y, int z) const
{
    const auto mean = [](double a, double b) { return static_cast<float>(0.5 * (a + b)); };
    return {mean(u[u_size().index(x, y, z)], u[u_size().index(x + 1, y, z)]),
            mean(v[v_size().index(x, y, z)], v[v_size().index(x, y + 1, z)]),
            mean(w[w_size().index(x, y, z)], w[w_size().index(x, y, z + 1)])};
}

Projection make_divergence_free(StaggeredWind& wind)
{
    Projection result;
    Poisson poisson(wind);
    const double speed = largest_speed(wind);
    const double goal = kTolerance * speed / std::min({wind.cell_m.x, wind.cell_m.y, wind.cell_m.z});
    std::vector<double> residual, lambda;
    result.before_per_s = poisson.largest_divergence(residual);
    result.after_per_s = result.before_per_s;
    // the recursive residual drifts from the true one by rounding: aim lower, look, and go on if need be
    for (int round = 0; round < 3 && result.after_per_s > goal; ++round)
    {
        result.iterations += poisson.solve(residual, 0.25 * goal, lambda);
        poisson.correct(lambda);
        result.after_per_s = poisson.largest_divergence(residual);
    }
    if (result.after_per_s > goal)
        throw Error(fmt::format(
            "the wind around the solids did not converge in {} iterations (divergence {:.3g} 1/s, goal "
            "{:.3g}); use larger wind cells",
            result.iterations, result.after_per_s, goal));
    return result;
}

}  // namespace spindrift::scene
