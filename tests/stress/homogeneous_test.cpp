// SPDX-License-Identifier: MIT
// Rows 1 and 5: turbulence that is the same everywhere, with all six stresses, for any step.
#include <array>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/turbulence.h"
#include "tests/stress/tracers.h"

namespace spindrift::stress
{
namespace
{

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix times(const Matrix& a, const Matrix& b)
{
    Matrix c{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    return c;
}

Matrix inverse(const Matrix& m)
{
    Matrix r{};
    double det = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
        {
            const std::size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            r[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
            if (i == 0) det += m[j][0] * r[0][j];
        }
    for (auto& row : r)
        for (double& v : row) v /= det;
    return r;
}

Matrix matrix(const Stress<double>& t)
{
    return {{{t.xx, t.xy, t.xz}, {t.xy, t.yy, t.yz}, {t.xz, t.yz, t.zz}}};
}

/// Covariance of the way gone in n steps: u' is a chain with u_k+1 = R u_k + noise, R = (1 - A) (1 + A)^-1
/// with A = (C0 eps h / 4) tau^-1, so <x x> = h^2 sum over |j - k| of R^|j - k| tau.
Matrix spread(const Matrix& tau, double c0_eps, double h, int n)
{
    Matrix plus = inverse(tau), minus{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
        {
            const double a = 0.25 * c0_eps * h * plus[i][j];
            plus[i][j] = (i == j ? 1.0 : 0.0) + a;
            minus[i][j] = (i == j ? 1.0 : 0.0) - a;
        }
    const Matrix r = times(minus, inverse(plus));
    Matrix sum{}, power = tau;
    for (int lag = 0; lag < n; ++lag)
    {
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                sum[i][j] += h * h * (lag == 0 ? n : 2.0 * (n - lag)) * power[i][j];
        power = times(r, power);
    }
    return sum;
}

/// The neutral surface layer with the wind aslant: no stress is zero.
Stress<double> aslant(double sigma)
{
    const double c = 0.8, s = 0.6, v = sigma * sigma / 6.25;
    Stress<double> t = neutral_normal_stress(c, s);
    t.xz = -c, t.yz = -s;
    return {t.xx * v, t.xy * v, t.xz * v, t.yy * v, t.yz * v, t.zz * v};
}

/// Row 1. Times of a whole step over those of the turbulence from 1e-3 to 1e3, sigma from 1e-4 to 10 m/s:
/// <u'_i u'_j> and the spread in all six components, within four standard deviations of chance.
TEST(Homogeneous, AllSixStressesAndTheirSpreadAreRightForEveryStep)
{
    constexpr std::size_t kFlakes = 6000;
    constexpr int kSteps = 60;
    constexpr double h = 0.1;
    double sigma = 1e-4;
    for (const double a : {1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e3})
    {
        const Stress<double> stress = aslant(sigma);
        const Matrix tau = matrix(stress);
        const double c0_eps = 2 * a / h * stress.zz;
        const Matrix moved = spread(tau, c0_eps, h, kSteps);
        const auto size = static_cast<float>(16 * std::sqrt(moved[0][0]));
        World w = tracer_world(kFlakes, {size, size, size}, h);
        w.on_leave = OnLeave::remove;
        w.emitters[0].shape = EmitterShape::point;
        w.emitters[0].a = {size / 2, size / 2, size / 2};
        w.wind = even_air(stress, c0_eps);
        TestRun run(w);
        run.steps(kSteps);
        ASSERT_EQ(run->counts().alive, kFlakes) << "a = " << a;
        ASSERT_EQ(run->extent().rogue, 0U) << "a = " << a;
        Matrix stresses{}, ways{};
        const WindCell& c = w.wind.cells[0];
        for (std::size_t i = 0; i < kFlakes; ++i)
        {
            const FlakeView& f = run.flakes;
            const float u[3] = {c.s11 * f.q1[i], c.s21 * f.q1[i] + c.s22 * f.q2[i],
                                c.s31 * f.q1[i] + c.s32 * f.q2[i] + c.s33 * f.q3[i]};
            const float x[3] = {f.x[i] - size / 2, f.y[i] - size / 2, f.z[i] - size / 2};
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t k = 0; k < 3; ++k)
                {
                    stresses[j][k] += static_cast<double>(u[j]) * static_cast<double>(u[k]) / kFlakes;
                    ways[j][k] += static_cast<double>(x[j]) * static_cast<double>(x[k]) / kFlakes;
                }
        }
        const auto expect = [&](const Matrix& is, const Matrix& truth, const char* what)
        {
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t k = j; k < 3; ++k)
                {
                    const double noise =
                        std::sqrt((truth[j][j] * truth[k][k] + truth[j][k] * truth[j][k]) / kFlakes);
                    EXPECT_NEAR(is[j][k], truth[j][k], 4 * noise)
                        << what << " " << j << k << ", a = " << a << ", sigma = " << sigma;
                }
        };
        expect(stresses, tau, "stress");
        expect(ways, moved, "spread");
        sigma *= 6.8;
    }
}

/// Row 5: whatever stands in a stress tensor and however long the step, every flake stays under control.
TEST(Homogeneous, AnyStressIsOrdinaryInput)
{
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> any(-1, 1);
    std::vector<Stress<double>> stresses{{},                     // calm
                                         {1, 0, 0, 0, 0, 0},     // along a line
                                         {1, 1, 0, 1, 0, 0},     // one direction aslant: det = 0
                                         {1, 0, 2, 1, 0, 1},     // one negative eigenvalue
                                         {-1, 0, 0, -1, 0, -1},  // none that is positive
                                         {1e-12, 0, 0, 1e-12, 0, 1e-12}};
    for (int i = 0; i < 12; ++i)
        stresses.push_back({any(engine), any(engine), any(engine), any(engine), any(engine), any(engine)});
    for (const double dt : {1e-4, 0.1, 10.0})
        for (std::size_t i = 0; i < stresses.size(); ++i)
            for (const double c0_eps : {0.0, 1.0, 1e6})
            {
                World w = tracer_world(64, {50, 50, 50}, dt);
                w.wind = even_air(stresses[i], c0_eps);
                for (float WindCell::*s : {&WindCell::s11, &WindCell::s22, &WindCell::s33})
                    ASSERT_TRUE(std::isfinite(w.wind.cells[0].*s));
                w.wind.cells[0].w = 0;
                w.has_ground = true;
                w.ground = {Contact::bounce, 1};
                w.voxels = cpu::test::voxels(
                    2, 2, 2, 25, [](int, int, int z) { return z == 1; },
                    [](int, int, int) { return std::uint8_t{0}; });
                w.surfaces = {{Contact::bounce, 1}};
                w.emitters[0].b = {50, 50, 25};
                TestRun run(w);
                run.steps(20);
                ASSERT_EQ(run->counts().alive, 64U) << "stress " << i << ", dt = " << dt;
                ASSERT_EQ(run->extent().rogue, 0U) << "stress " << i << ", dt = " << dt << ", " << c0_eps;
                ASSERT_EQ(misplaced(w, run), 0U);
            }
}

}  // namespace
}  // namespace spindrift::stress
