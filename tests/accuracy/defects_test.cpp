// SPDX-License-Identifier: MIT
// Faults that earlier Lagrangian snow and plume codes are known to have had. Each test fails on its fault.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/langevin.h"
#include "core/wind.h"
#include "scene/flow_field.h"
#include "validation/worlds.h"

namespace spindrift::validation
{

namespace
{

Settings with(std::uint64_t particles)
{
    Settings settings;
    settings.particles = particles;
    settings.threads = 2;
    return settings;
}

/// Stresses that flakes show by their paths over one short step at 10 m, in the wind's own axes.
Stress<double> stress_of_paths(double angle, float friction_m_s)
{
    constexpr double kDt = 0.02;
    World w = empty_world(with(20000), kDt, {60, 60, 20});
    w.wind.kind = WindKind::logarithmic;
    w.wind.turbulent = true;
    w.wind.friction_velocity_m_s = friction_m_s;
    w.wind.to_x = static_cast<float>(std::cos(angle)), w.wind.to_y = static_cast<float>(std::sin(angle));
    add_burst(w, {30, 30, 10}, {30, 30, 10});
    FlakeRun run(w, with(0));
    run.step();
    const double u = static_cast<double>(friction_m_s) / kVonKarman * std::log((10 + 0.1) / 0.1);
    Stress<double> sum{};
    for (std::size_t i = 0; i < run.slots(); ++i)
    {
        const double x = (run.flakes().x[i] - 30) / kDt, y = (run.flakes().y[i] - 30) / kDt;
        const double along = std::cos(angle) * x + std::sin(angle) * y - u,
                     across = std::cos(angle) * y - std::sin(angle) * x, up = (run.flakes().z[i] - 10) / kDt;
        const double n = static_cast<double>(run.slots()) * static_cast<double>(friction_m_s) *
                         static_cast<double>(friction_m_s);
        sum.xx += along * along / n, sum.xy += along * across / n, sum.xz += along * up / n;
        sum.yy += across * across / n, sum.yz += across * up / n, sum.zz += up * up / n;
    }
    return sum;
}

// Four standard deviations of 20 000 flakes, and a few per mille that the layer has thinned out to at 10 m.
TEST(Defects, SigmasAreThoseOfTheSurfaceLayer)
{
    const Stress<double> s = stress_of_paths(0, 0.4F);
    EXPECT_NEAR(s.xx, 6.25, 6.25 * 0.06);
    EXPECT_NEAR(s.yy, 4.0, 4.0 * 0.06);
    EXPECT_NEAR(s.zz, 1.69, 1.69 * 0.06);
}

TEST(Defects, MomentumGoesDown)
{
    EXPECT_NEAR(stress_of_paths(0, 0.4F).xz, -1, 0.12);
}

TEST(Defects, TurbulenceTurnsWithTheWindAtAnySpeed)
{
    for (const double angle : {0.6, 1.9, 4.0})
        for (const float friction : {0.1F, 1.5F})
        {
            const Stress<double> s = stress_of_paths(angle, friction);
            EXPECT_NEAR(s.xx, 6.25, 6.25 * 0.06) << angle;
            EXPECT_NEAR(s.yy, 4.0, 4.0 * 0.06) << angle;
            EXPECT_NEAR(s.xz, -1, 0.12) << angle;
            EXPECT_NEAR(s.xy, 0, 0.15) << angle;
            EXPECT_NEAR(s.yz, 0, 0.08) << angle;
        }
}

scene::FlowField still_air(GridSize size, double cell_m)
{
    scene::FlowField flow;
    flow.size = size;
    flow.cell_m = {cell_m, cell_m, cell_m};
    flow.mean.assign(size.count(), {0, 0, 0});
    flow.solid.assign(size.count(), 0);
    return flow;
}

TEST(Defects, GriddedTurbulenceTurnsWithTheWindAtAnySpeed)
{
    for (const double angle : {0.0, 0.6, 1.9, 4.0})
        for (const double friction : {0.1, 1.5})
        {
            scene::FlowField flow = still_air({5, 5, 12}, 2);
            for (int z = 0; z < 12; ++z)
                for (int y = 0; y < 5; ++y)
                    for (int x = 0; x < 5; ++x)
                    {
                        const double u = friction / kVonKarman * std::log((2 * z + 1 + 0.1) / 0.1);
                        flow.mean[flow.size.index(x, y, z)] = {static_cast<float>(u * std::cos(angle)),
                                                               static_cast<float>(u * std::sin(angle)), 0};
                    }
            scene::close_from_shear({0.1, 1000, friction}, flow);
            const Stress<float>& t = flow.stress[flow.size.index(2, 2, 6)];
            const double c = std::cos(angle), s = std::sin(angle),
                         f2 = friction * friction * std::pow(1 - 0.013, 1.5);
            EXPECT_NEAR((c * c * t.xx + 2 * c * s * t.xy + s * s * t.yy) / f2, 6.25, 0.2) << angle;
            EXPECT_NEAR((s * s * t.xx - 2 * c * s * t.xy + c * c * t.yy) / f2, 4.0, 0.15) << angle;
            EXPECT_NEAR((c * t.xz + s * t.yz) / f2, -1, 0.05) << angle;
            EXPECT_NEAR((c * t.yz - s * t.xz) / f2, 0, 0.02) << angle;
        }
}

TEST(Defects, CalmAirIsNoDivisionByZero)
{
    for (const int calm_axis : {0, 1, 2})  // 2: no wind at all
    {
        scene::FlowField flow = still_air({6, 6, 6}, 2);
        for (int z = 0; z < 6; ++z)
            for (std::size_t i = 0; i < 36; ++i)
            {
                const float speed = calm_axis == 2 ? 0.0F : static_cast<float>(z);
                flow.mean[static_cast<std::size_t>(z) * 36 + i] = {calm_axis == 0 ? 0 : speed,
                                                                   calm_axis == 1 ? 0 : speed, 0};
            }
        scene::close_from_shear({0.1, 1000, 0.3}, flow);
        for (const Stress<float>& t : flow.stress)
            EXPECT_TRUE(std::isfinite(t.xx + t.xy + t.xz + t.yy + t.yz + t.zz));
        World w = empty_world(with(2000), 0.1, {12, 12, 12});
        scene::fill_wind_grid(flow, w.wind);
        for (const WindCell& cell : w.wind.cells)
            EXPECT_TRUE(std::isfinite(cell.u + cell.v + cell.w + cell.gradient + cell.s11 + cell.s21 +
                                      cell.s22 + cell.s31 + cell.s32 + cell.s33 + cell.div_s1 + cell.div_s2 +
                                      cell.div_s3));
        add_burst(w, {1, 1, 1}, {11, 11, 11});
        FlakeRun run(w, with(0));
        run.steps(50);
        EXPECT_EQ(run.rogue(), 0U);
        EXPECT_EQ(run.backend().counts().vanished, 0U);
    }
}

/// S = 1 + slope · x on the diagonal, another slope for each component and direction.
constexpr std::array<std::array<double, 3>, 3> kSlopes = {
    {{0.05, 0.02, 0.01}, {0.03, 0.07, 0.04}, {0.06, 0.08, 0.09}}};

double sloped(int component, double x, double y, double z)
{
    const auto& s = kSlopes[static_cast<std::size_t>(component)];
    return 1 + s[0] * x + s[1] * y + s[2] * z;
}

Wind sloped_wind(GridSize size, const std::array<bool, 3>& varies)
{
    scene::FlowField flow = still_air(size, 0.5);
    flow.c0_eps.assign(size.count(), 1);
    for (int z = 0; z < size.nz; ++z)
        for (int y = 0; y < size.ny; ++y)
            for (int x = 0; x < size.nx; ++x)
            {
                const auto s = [&](int k)
                {
                    return sloped(k, varies[0] ? 0.5 * (x + 0.5) : 0, varies[1] ? 0.5 * (y + 0.5) : 0,
                                  varies[2] ? 0.5 * (z + 0.5) : 0);
                };
                const auto f = [](double v) { return static_cast<float>(v); };
                flow.stress.push_back({f(s(0) * s(0)), 0, 0, f(s(1) * s(1)), 0, f(s(2) * s(2))});
            }
    Wind wind;
    scene::fill_wind_grid(flow, wind);
    return wind;
}

TEST(Defects, EveryDirectionOfTheTurbulenceIsReadFromItsOwnNeighbours)
{
    const Wind wind = sloped_wind({7, 9, 11}, {true, true, true});
    const GridWind grid = grid_wind(wind, wind.cells.data());
    for (const Vec3<double> x : {Vec3<double>{1.1, 2.3, 3.4}, {2.9, 1.0, 0.9}, {0.6, 3.7, 4.8}})
    {
        const Air<double> air = grid.air(x);
        EXPECT_NEAR(air.s11, sloped(0, x.x, x.y, x.z), 1e-6);
        EXPECT_NEAR(air.s22, sloped(1, x.x, x.y, x.z), 1e-6);
        EXPECT_NEAR(air.s33, sloped(2, x.x, x.y, x.z), 1e-6);
    }
}

TEST(Defects, DivergenceAndGradientTakeEachDirectionFromItsOwnDifference)
{
    const Wind wind = sloped_wind({7, 9, 11}, {true, true, true});
    const Air<double> air = grid_wind(wind, wind.cells.data()).air(Vec3<double>{1.6, 2.1, 2.7});
    EXPECT_NEAR(air.div_s.x, 0.05, 1e-5);
    EXPECT_NEAR(air.div_s.y, 0.07, 1e-5);
    EXPECT_NEAR(air.div_s.z, 0.09, 1e-5);
    EXPECT_NEAR(air.gradient, 0.09, 1e-5);
}

TEST(Defects, AGradientInAnyDirectionAloneShortensTheStep)
{
    const std::array<double, 3> steepest = {0.06, 0.08, 0.09};  // over the components
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        std::array<bool, 3> varies{};
        varies[axis] = true;
        const Wind wind = sloped_wind({8, 8, 8}, varies);
        const Air<float> air = grid_wind(wind, wind.cells.data()).air(Vec3<float>{2, 2, 2});
        EXPECT_EQ(substeps<float>(air.gradient, 9.5F),
                  static_cast<int>(std::ceil(steepest[axis] * 9.5 / kGradientLimit)))
            << axis;
    }
}

TEST(Defects, ASphereEmitsEvenlyAndNotLikeACube)
{
    World w = empty_world(with(40000), 1e-6, {10, 10, 10});
    w.wind.kind = WindKind::uniform;
    Emitter e;
    e.shape = EmitterShape::sphere_surface;
    e.a = {5, 5, 5}, e.radius_m = 2, e.burst = 40000;
    w.emitters.push_back(e);
    FlakeRun run(w, with(0));
    run.step();
    // within 20 degrees of the eight corners of a cube, of its six faces
    double corners = 0, faces = 0;
    const double cosine = std::cos(20 * std::numbers::pi / 180);
    for (std::size_t i = 0; i < run.slots(); ++i)
    {
        const double x = std::abs(run.flakes().x[i] - 5) / 2, y = std::abs(run.flakes().y[i] - 5) / 2,
                     z = std::abs(run.flakes().z[i] - 5) / 2;
        corners += (x + y + z) / std::sqrt(3.0) > cosine ? 1 : 0;
        faces += std::max({x, y, z}) > cosine ? 1 : 0;
    }
    const double cap = 40000 * (1 - cosine) / 2;  // one cap's share of the sphere
    EXPECT_NEAR(corners, 8 * cap, 4 * std::sqrt(8 * cap));
    EXPECT_NEAR(faces, 6 * cap, 4 * std::sqrt(6 * cap));
}

TEST(Defects, NoTwoFlakesAndNoTwoStepsShareTheirRandomNumbers)
{
    constexpr std::size_t kFlakes = 20000;
    // fully relaxed in a step: a = 2 keeps nothing of the step before
    World w = empty_world(with(kFlakes), 0.1, {100, 100, 100});
    w.wind = wind_everywhere(isotropic(1, 20));
    add_burst(w, {50, 50, 50}, {50, 50, 50});
    FlakeRun run(w, with(0));
    std::vector<std::vector<float>> q;
    for (int step = 0; step < 3; ++step)
    {
        run.step();
        q.emplace_back(run.flakes().q1, run.flakes().q1 + kFlakes);
        q.emplace_back(run.flakes().q3, run.flakes().q3 + kFlakes);
    }
    const auto correlation = [&](const std::vector<float>& a, const std::vector<float>& b, std::size_t lag)
    {
        double sum = 0;
        for (std::size_t i = 0; i < kFlakes; ++i)
            sum += static_cast<double>(a[i]) * static_cast<double>(b[(i + lag) % kFlakes]);
        return sum / kFlakes;
    };
    const double noise = 1 / std::sqrt(static_cast<double>(kFlakes));
    for (std::size_t a = 0; a < q.size(); ++a)
    {
        for (std::size_t b = a + 1; b < q.size(); ++b)
            EXPECT_NEAR(correlation(q[a], q[b], 0), 0, 4.5 * noise);
        for (const std::size_t lag : {1U, 2U, 8U, 16U, 256U, 1024U, 4096U})
            EXPECT_NEAR(correlation(q[a], q[a], lag), 0, 4.5 * noise) << lag;
    }
}

TEST(Defects, WallsOnAllSixSidesHoldHoweverOftenAFlakeBounces)
{
    constexpr int kCells = 8;  // of 1 m; the outermost are walls
    World w = empty_world(with(2000), 2, {kCells, kCells, kCells});
    w.wind = wind_everywhere(isotropic(8, 0.1));  // 16 m a step in a room of 6 m
    VoxelGrid& v = w.voxels;
    v.nx = v.ny = v.nz = kCells, v.cell_m = 1;
    for (int z = 0; z < kCells; ++z)
        for (int y = 0; y < kCells; ++y)
            for (int x = 0; x < kCells; ++x)
            {
                const auto inside = [](int i) { return std::min(i, kCells - 1 - i); };
                v.clearance.push_back(static_cast<std::uint8_t>(std::min({inside(x), inside(y), inside(z)})));
                v.surface.push_back(0);
            }
    w.surfaces = {{Contact::bounce, 1}};
    add_burst(w, {1.1F, 1.1F, 1.1F}, {6.9F, 6.9F, 6.9F});
    FlakeRun run(w, with(0));
    for (int step = 0; step < 60; ++step)
    {
        run.step();
        ASSERT_EQ(run.backend().counts().alive, 2000U) << step;
        for (std::size_t i = 0; i < run.slots(); ++i)
            for (const float x : {run.flakes().x[i], run.flakes().y[i], run.flakes().z[i]})
            {
                ASSERT_GE(x, 1);
                ASSERT_LE(x, kCells - 1);
            }
    }
}

TEST(Defects, FaintTurbulenceMakesNoRogues)
{
    for (const double sigma : {1e-6, 1e-3, 0.02})
    {
        World w = empty_world(with(1000), 0.1, {10, 10, 10});
        AirLevel air = isotropic(sigma, 2);
        air.mean_m_s = {1, 0, 0};
        w.wind = wind_everywhere(air);
        add_burst(w, {1, 1, 5}, {9, 9, 5});
        FlakeRun run(w, with(0));
        run.steps(50);
        EXPECT_EQ(run.rogue(), 0U);
        EXPECT_EQ(run.backend().counts().alive, 1000U);
        double square = 0;
        for (std::size_t i = 0; i < run.slots(); ++i)
            square += static_cast<double>(run.flakes().q2[i]) * static_cast<double>(run.flakes().q2[i]);
        EXPECT_NEAR(square / 1000, 1, 4 * std::sqrt(2 / 1000.0));
    }
}

}  // namespace

}  // namespace spindrift::validation
