// SPDX-License-Identifier: MIT
#include "core/blown_wind.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace spindrift
{
namespace
{

/// A grid of air with gusts and bodies, and the memory behind it.
struct Blown
{
    Wind wind;
    std::vector<WindCell> state, now;
    std::vector<double> times{0};
    std::vector<float> stream;
    std::vector<BodyView> views;
    std::vector<MovingBody> moving;
    BlownWind blown;

    explicit Blown(const Wind& w) : wind(w), state(w.cells), now(w.cells)
    {
        blown = blown_wind(wind, 0.02);
        blown.states = {state.data(), times.data(), 1, state.size(), now.data()};
        blown.gust_share = wind.gust_share.data();
        stream.resize(static_cast<std::size_t>((wind.nx + 2) * (wind.ny + 2)));
        blown.stream_m2_s = stream.data();
        for (const Body& body : wind.bodies)
            views.push_back(
                {{body.path.keys.data(), static_cast<std::uint32_t>(body.path.keys.size()), false, {}},
                 body.size_m});
        moving.resize(views.size());
        blown.bodies = views.data();
        blown.moving = moving.data();
    }

    void step(std::uint64_t number)
    {
        blown.place_bodies(number);
        for (std::size_t i = 0; i < blown.stream_points(); ++i) blown.stream(number, i);
        const WindMoment moment = moment_of(blown.states, blown.time_of(number));
        for (std::size_t i = 0; i < now.size(); ++i) blown.cell(moment, i);
    }

    std::size_t index(int x, int y, int z) const
    {
        return static_cast<std::size_t>((z * wind.ny + y) * wind.nx + x);
    }
};

Wind steady(int nx, int ny, int nz, Vec3f velocity_m_s)
{
    Wind w;
    w.kind = WindKind::grid;
    w.nx = nx, w.ny = ny, w.nz = nz;
    w.cell_m = {2, 2, 2}, w.origin_m = {1, 1, 1};
    WindCell cell{};
    cell.u = velocity_m_s.x, cell.v = velocity_m_s.y;
    w.cells.assign(static_cast<std::size_t>(nx * ny * nz), cell);
    w.gust_share.assign(w.cells.size(), 1.0F);
    return w;
}

TEST(Gusts, HaveTheStatedSpeedAndAreCarriedAlongFrozen)
{
    const GustPattern pattern = gust_pattern({3, 80, {7, -2, 0}, 5});
    double square = 0;
    int n = 0;
    constexpr double h = 0.05;
    for (double x = 0; x < 4000; x += 37.3)
        for (double y = 0; y < 4000; y += 41.1, ++n)
        {
            const auto at = [&](double dx, double dy)
            { return static_cast<double>(pattern.stream(x + dx, y + dy, 12)); };
            const double u = (at(0, h) - at(0, -h)) / (2 * h), v = (at(-h, 0) - at(h, 0)) / (2 * h);
            square += 0.5 * (u * u + v * v);
        }
    EXPECT_NEAR(std::sqrt(square / n), 3, 0.06);
    for (const double t : {0.5, 100.0, 86400.0})
        EXPECT_NEAR(pattern.stream(200 + 7 * t, 100 - 2 * t, t), pattern.stream(200, 100, 0), 0.02) << t;
    EXPECT_NE(pattern.stream(1, 2, 3), gust_pattern({3, 80, {7, -2, 0}, 6}).stream(1, 2, 3)) << "the seed";
}

TEST(Gusts, OnAGridHaveNoDivergenceAndLeaveSolidsAlone)
{
    Wind w = steady(24, 20, 3, {5, 0, 0});
    w.gusts = {3, 30, {5, 0, 0}, 1};
    for (int z = 0; z < 3; ++z)
        for (int y = 6; y < 9; ++y)
            for (int x = 10; x < 13; ++x)
            {
                const auto i = static_cast<std::size_t>((z * 20 + y) * 24 + x);
                w.gust_share[i] = 0;
                w.cells[i] = WindCell{};
            }
    Blown grid(w);
    grid.step(100);
    double largest = 0, change = 0;
    for (int y = 2; y < 18; ++y)
        for (int x = 2; x < 22; ++x)
        {
            const WindCell& c = grid.now[grid.index(x, y, 1)];
            change = std::max(change, std::abs(static_cast<double>(c.v)));
            if (grid.wind.gust_share[grid.index(x, y, 1)] == 0)
            {
                EXPECT_EQ(c.u, 0);
                EXPECT_EQ(c.v, 0);
            }
            bool beside_solid = false;
            for (int d = -2; d <= 2; ++d)
                beside_solid = beside_solid || grid.wind.gust_share[grid.index(x + d, y, 1)] == 0 ||
                               grid.wind.gust_share[grid.index(x, y + d, 1)] == 0;
            if (beside_solid) continue;
            const double divergence = static_cast<double>(grid.now[grid.index(x + 1, y, 1)].u -
                                                          grid.now[grid.index(x - 1, y, 1)].u +
                                                          grid.now[grid.index(x, y + 1, 1)].v -
                                                          grid.now[grid.index(x, y - 1, 1)].v) /
                                      4.0;
            largest = std::max(largest, std::abs(divergence));
        }
    EXPECT_GT(change, 1);
    EXPECT_LT(largest, 2e-6) << "1/s";
}

TEST(VehicleWake, HasNoDivergenceAndIsLevelAtTheGround)
{
    MovingBody body;
    body.place = {0, 0, 0};
    body.to_x = 0.6F, body.to_y = 0.8F;
    body.excess_m_s = 20, body.length_m = 8, body.frontal_m2 = 7.5F;
    constexpr double h = 1e-3;
    for (double s = -60; s < 12; s += 0.73)
        for (const double across : {-3.0, 0.0, 0.4, 2.0})
            for (const double z : {0.3, 1.0, 4.0})
            {
                const Vec3d x{0.6 * s - 0.8 * across, 0.8 * s + 0.6 * across, z};
                const auto at = [&](double dx, double dy, double dz) {
                    return vehicle_wake(body, Vec3d{x.x + dx, x.y + dy, x.z + dz});
                };
                const double divergence = (at(h, 0, 0).x - at(-h, 0, 0).x + at(0, h, 0).y - at(0, -h, 0).y +
                                           at(0, 0, h).z - at(0, 0, -h).z) /
                                          (2 * h);
                EXPECT_NEAR(divergence, 0, 2e-5) << s << " " << across << " " << z;
                EXPECT_EQ(vehicle_wake(body, Vec3d{x.x, x.y, 0}).z, 0);
            }
}

TEST(VehicleWake, GoesAlongBesideTheBodyAndFallsAsTheSimilarWakeDoes)
{
    MovingBody body;
    body.excess_m_s = 20, body.length_m = 8, body.frontal_m2 = 7.5F;
    const auto along = [&](double s) { return vehicle_wake(body, Vec3d{s, 0, 0}).x; };
    EXPECT_NEAR(along(0), 20, 1e-6);
    EXPECT_LT(along(4 + 10), 1e-6) << "far before it nothing moves";
    const double bubble = 2 * std::sqrt(7.5);
    EXPECT_NEAR(along(-4 - 2 * bubble) / along(-4 - 4 * bubble), std::pow(17.0 / 5.0, 1.0 / 3.0), 0.12);
    EXPECT_GT(vehicle_wake(body, Vec3d{6, 2, 1}).y, 0.5) << "air before it is pushed aside";
}

TEST(BlownWind, MovesABodyByItsPathAgainstTheWind)
{
    Wind w = steady(20, 20, 5, {5, 0, 0});
    w.bodies = {{{{{0.0, {10, 20, 0}}, {2.0, {30, 20, 0}}}}, {6, 2.5F, 3}},
                {{{{0.0, {30, 30, 0}}}}, {6, 2, 3}}};
    Blown grid(w);
    grid.step(50);  // 1.01 s
    EXPECT_NEAR(grid.moving[0].place.x, 20.1F, 1e-4);
    EXPECT_NEAR(grid.moving[0].excess_m_s, 5, 1e-3) << "10 m/s over the ground, 5 over the air";
    EXPECT_EQ(grid.moving[1].frontal_m2, 0) << "one that stands disturbs nothing";
    const WindCell& beside = grid.now[grid.index(9, 9, 0)];
    EXPECT_GT(beside.u, 7);
    EXPECT_LT(beside.u, 10.001);
}

}  // namespace
}  // namespace spindrift
