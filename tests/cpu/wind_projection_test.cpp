// SPDX-License-Identifier: MIT
#include "cpu/wind_projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace spindrift::cpu
{
namespace
{

StaggeredWind uniform(GridSize n, Vec3d cell, double u)
{
    StaggeredWind wind(n, cell);
    wind.u.assign(wind.u.size(), u);
    return wind;
}

void make_block(StaggeredWind& wind, int x0, int x1, int y0, int y1, int z0, int z1)
{
    for (int z = z0; z < z1; ++z)
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) wind.solid[wind.size.index(x, y, z)] = 1;
}

double largest_divergence(const StaggeredWind& wind)
{
    double most = 0;
    for (int z = 0; z < wind.size.nz; ++z)
        for (int y = 0; y < wind.size.ny; ++y)
            for (int x = 0; x < wind.size.nx; ++x)
                if (wind.solid[wind.size.index(x, y, z)] == 0)
                    most = std::max(most, std::abs(wind.divergence(x, y, z)));
    return most;
}

void expect_closed(const StaggeredWind& wind)
{
    for (int z = 0; z < wind.size.nz; ++z)
        for (int y = 0; y < wind.size.ny; ++y)
            for (int x = 0; x < wind.size.nx; ++x)
            {
                ASSERT_TRUE(z > 0 || wind.w[wind.w_size().index(x, y, 0)] == 0) << "flow through the ground";
                if (wind.solid[wind.size.index(x, y, z)] == 0) continue;
                for (int upper = 0; upper < 2; ++upper)
                {
                    ASSERT_EQ(wind.u[wind.u_size().index(x + upper, y, z)], 0);
                    ASSERT_EQ(wind.v[wind.v_size().index(x, y + upper, z)], 0);
                    ASSERT_EQ(wind.w[wind.w_size().index(x, y, z + upper)], 0);
                }
            }
}

TEST(MakeDivergenceFree, LeavesAnUndisturbedWindAlone)
{
    StaggeredWind wind = uniform({12, 10, 8}, {2, 2, 2}, 5);
    const Projection done = make_divergence_free(wind);
    EXPECT_EQ(done.iterations, 0);
    for (const double u : wind.u) ASSERT_EQ(u, 5);
}

TEST(MakeDivergenceFree, FlowsRoundABlockAndNotIntoIt)
{
    StaggeredWind wind = uniform({40, 30, 20}, {2, 2, 2}, 5);
    make_block(wind, 16, 22, 12, 18, 0, 8);
    const Projection done = make_divergence_free(wind);
    EXPECT_GT(done.before_per_s, 1);
    EXPECT_LE(largest_divergence(wind), 1e-6 * 5 * 1.3 / 2) << "1.3: the wind is faster beside the block";
    expect_closed(wind);
    // faster beside and above, slower before and behind, the same far upwind
    EXPECT_GT(wind.centre(19, 19, 2).x, 5.5);
    EXPECT_GT(wind.centre(19, 15, 9).x, 5.5);
    EXPECT_LT(wind.centre(14, 15, 2).x, 4);
    EXPECT_LT(wind.centre(23, 15, 2).x, 4);
    EXPECT_GT(wind.centre(14, 17, 2).y, 0.2) << "turns outwards before the block";
    EXPECT_LT(wind.centre(14, 12, 2).y, -0.2);
    EXPECT_NEAR(wind.centre(0, 2, 18).x, 5, 0.05);
    // mirror symmetry across the wind
    for (int x = 0; x < 40; ++x)
        for (int y = 0; y < 15; ++y) ASSERT_NEAR(wind.centre(x, y, 3).x, wind.centre(x, 29 - y, 3).x, 1e-4);
}

TEST(MakeDivergenceFree, ChangesTheWindAsLittleAsPossible)
{
    // Least squares: the change is orthogonal to the result, and a second projection finds nothing to do.
    StaggeredWind wind = uniform({20, 16, 12}, {1, 1, 1}, 3);
    make_block(wind, 6, 10, 5, 9, 0, 6);
    StaggeredWind closed = wind;
    make_divergence_free(wind);
    for (std::size_t i = 0; i < wind.u.size(); ++i) closed.u[i] = wind.u[i] == 0 ? 0 : closed.u[i];
    double product = 0, size = 0;
    const auto add =
        [&](const std::vector<double>& before, const std::vector<double>& after, GridSize n, int axis)
    {
        for (std::size_t i = 0; i < after.size(); ++i)
        {
            const int at[3] = {static_cast<int>(i) % n.nx, static_cast<int>(i) / n.nx % n.ny,
                               static_cast<int>(i) / n.nx / n.ny};
            const int last[3] = {n.nx - 1, n.ny - 1, n.nz - 1};
            const double share = at[axis] == 0 || at[axis] == last[axis] ? 0.5 : 1;  // of a cell's volume
            product += share * (after[i] - before[i]) * after[i];
            size += share * (after[i] - before[i]) * (after[i] - before[i]);
        }
    };
    add(closed.u, wind.u, wind.u_size(), 0);
    add(closed.v, wind.v, wind.v_size(), 1);
    add(closed.w, wind.w, wind.w_size(), 2);
    EXPECT_GT(size, 1);
    EXPECT_LT(std::abs(product), 1e-4 * size);
    EXPECT_EQ(make_divergence_free(wind).iterations, 0);
}

TEST(MakeDivergenceFree, AirThatIsShutInComesToRest)
{
    StaggeredWind wind = uniform({12, 12, 12}, {1, 1, 1}, 5);
    make_block(wind, 3, 9, 3, 9, 0, 9);
    for (int z = 1; z < 7; ++z)
        for (int y = 5; y < 7; ++y)
            for (int x = 5; x < 7; ++x) wind.solid[wind.size.index(x, y, z)] = 0;
    make_divergence_free(wind);
    for (int x = 5; x < 7; ++x) EXPECT_EQ(wind.centre(x, 5, 3).x, 0);
    EXPECT_LE(largest_divergence(wind), 1e-6 * 10);
}

TEST(MakeDivergenceFree, TakesGridsOfOneCellAndOfNothingButSolid)
{
    StaggeredWind one = uniform({1, 1, 1}, {1, 1, 1}, 3);
    one.u[1] = 5;
    make_divergence_free(one);
    EXPECT_NEAR(one.divergence(0, 0, 0), 0, 1e-5);
    StaggeredWind solid = uniform({4, 4, 4}, {1, 1, 1}, 3);
    make_block(solid, 0, 4, 0, 4, 0, 4);
    make_divergence_free(solid);
    for (const double u : solid.u) EXPECT_EQ(u, 0);
}

TEST(MakeDivergenceFree, ConvergesOnRandomRuins)
{
    std::mt19937 engine(4);
    for (const double share : {0.1, 0.35, 0.6})
    {
        StaggeredWind wind = uniform({24, 20, 16}, {1, 2, 0.5}, 4);
        for (auto& s : wind.solid) s = std::uniform_real_distribution<>(0, 1)(engine) < share ? 1 : 0;
        const Projection done = make_divergence_free(wind);
        EXPECT_LT(done.iterations, 400);
        expect_closed(wind);
        EXPECT_LE(largest_divergence(wind), 1e-6 * 40);
    }
}

TEST(MakeDivergenceFree, TakesLayersOfUnequalThickness)
{
    std::vector<double> layers;
    for (int k = 0; k < 17; ++k) layers.push_back(0.5 * std::pow(1.12, k));
    StaggeredWind wind({31, 27, 17}, {1, 1.5, 1}, layers);
    wind.u.assign(wind.u.size(), 5);
    wind.v.assign(wind.v.size(), -2);
    make_block(wind, 9, 16, 10, 15, 0, 8);
    make_block(wind, 20, 23, 3, 22, 0, 11);
    for (int x = 11; x < 14; ++x) wind.solid[wind.size.index(x, 12, 3)] = 0;  // shut in
    const Projection done = make_divergence_free(wind);
    EXPECT_LE(done.relative_residual, 1e-6);
    EXPECT_LE(largest_divergence(wind), 1e-6 * 12 / 0.5);
    EXPECT_GT(largest_divergence(wind), 0);
    expect_closed(wind);
    EXPECT_EQ(wind.u[wind.u_size().index(12, 12, 3)], 0) << "air that is shut in comes to rest";
    for (const auto* faces : {&wind.u, &wind.v, &wind.w})
        for (const double v : *faces) ASSERT_LT(std::abs(v), 20);
}

TEST(MakeDivergenceFree, IsTheSameForAnyNumberOfThreads)
{
    StaggeredWind one = uniform({40, 50, 30}, {2, 2, 1}, 5);
    make_block(one, 10, 17, 12, 23, 0, 13);
    StaggeredWind three = one;
    ProjectionSettings settings;
    settings.threads = 1;
    make_divergence_free(one, settings);
    settings.threads = 3;
    make_divergence_free(three, settings);
    EXPECT_EQ(one.u, three.u);
    EXPECT_EQ(one.w, three.w);
}

}  // namespace
}  // namespace spindrift::cpu
