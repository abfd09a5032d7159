// SPDX-License-Identifier: MIT
#include "scene/staggered_wind.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "scene/project_wind.h"

namespace spindrift::scene
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
    const auto add = [&](const std::vector<double>& before, const std::vector<double>& after)
    {
        for (std::size_t i = 0; i < after.size(); ++i)
        {
            product += (after[i] - before[i]) * after[i];
            size += (after[i] - before[i]) * (after[i] - before[i]);
        }
    };
    add(closed.u, wind.u);
    add(closed.v, wind.v);
    add(closed.w, wind.w);
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

Wind log_profile()
{
    Wind wind;
    wind.friction_velocity_m_s = 0.4F;
    wind.roughness_m = 0.1F;
    wind.boundary_layer_m = 500;
    wind.to_x = 0.8F;
    wind.to_y = 0.6F;
    return wind;
}

TEST(WindAroundSolids, IsTheProfileWhereNothingStands)
{
    const StaggeredWind wind = wind_around_solids(log_profile(), {40, 40, 40}, 2, {});
    for (int k = 0; k < 20; ++k)
    {
        const double expected = std::log((2 * (k + 0.5) + 0.1) / 0.1);
        EXPECT_NEAR(wind.centre(10, 10, k).x, 0.8 * expected, 1e-5 * expected);
        EXPECT_NEAR(wind.centre(10, 10, k).y, 0.6 * expected, 1e-5 * expected);
    }
}

TEST(WindAroundSolids, RefusesAGroundAboveTheDomain)
{
    Wind profile = log_profile();
    profile.ground_m = 50;
    EXPECT_THROW(wind_around_solids(profile, {40, 40, 40}, 2, {}), Error);
}

TEST(CloseFromShear, IsTheSurfaceLayerInALogarithmicWind)
{
    const Wind profile = log_profile();
    FlowField flow = cell_means(wind_around_solids(profile, {20, 20, 60}, 2, {}), {0, 0, 0});
    close_from_shear({0.1, 500, 0.4}, flow);
    Wind wind = profile;
    fill_wind_grid(flow, wind);
    for (int k = 0; k < 29;
         ++k)  // the topmost cell has a one-sided difference, exact too, but no neighbour for div_s
    {
        const double z = 2 * (k + 0.5), f2 = 0.16 * std::pow(1 - z / 500, 1.5);
        const std::size_t i = flow.size.index(5, 5, k);
        const Stress<float>& t = flow.stress[i];
        const double c = 0.8, s = 0.6;
        EXPECT_NEAR(c * c * t.xx + 2 * c * s * t.xy + s * s * t.yy, 6.25 * f2, 2e-3 * f2)
            << "along, " << z << " m";
        EXPECT_NEAR(s * s * t.xx - 2 * c * s * t.xy + c * c * t.yy, 4 * f2, 2e-3 * f2);
        EXPECT_NEAR(t.zz, 1.69 * f2, 2e-3 * f2);
        EXPECT_NEAR(c * t.xz + s * t.yz, -f2, 2e-3 * f2) << "momentum goes down";
        EXPECT_NEAR(-s * t.xz + c * t.yz, 0, 2e-3 * f2);
        const double c0_eps = 5.7 * 0.064 / (0.4 * z) * std::pow(1 - 0.85 * z / 500, 1.5);
        EXPECT_NEAR(flow.c0_eps[i], c0_eps, 2e-3 * c0_eps);
        if (k == 0) continue;
        // dS3j/dz of S = f(z) S0, f = u* (1 - z/zi)^(3/4)
        const WindCell& cell = wind.cells[i];
        const double slope = -0.75 / (500 - z);
        EXPECT_NEAR(cell.div_s3, slope * cell.s33, 0.02 * std::abs(slope) * cell.s33);
        EXPECT_NEAR(cell.div_s1, slope * cell.s31, 0.02 * std::abs(slope * cell.s31));
    }
}

TEST(CloseFromShear, HoldsTheTurbulenceBesideABlockWithinBounds)
{
    VoxelGrid voxels;
    voxels.nx = voxels.ny = voxels.nz = 40;
    voxels.clearance.assign(64000, 1);
    const GridSize n{40, 40, 40};
    for (int z = 0; z < 20; ++z)
        for (int y = 14; y < 26; ++y)
            for (int x = 14; x < 26; ++x) voxels.clearance[n.index(x, y, z)] = 0;
    Wind wind = log_profile();
    FlowField flow = cell_means(wind_around_solids(wind, {40, 40, 40}, 2, voxels), {0, 0, 0});
    EXPECT_EQ(std::count(flow.solid.begin(), flow.solid.end(), 1), 6 * 6 * 10);
    close_from_shear({0.1, 500, 0.4}, flow);
    fill_wind_grid(flow, wind);
    for (const WindCell& cell : wind.cells)
    {
        const auto* v = reinterpret_cast<const float*>(&cell);
        for (int i = 0; i < 16; ++i) ASSERT_TRUE(std::isfinite(v[i]));
        ASSERT_LE(cell.s11, std::sqrt(20.0) * 0.4 * 1.3);
        ASSERT_GT(cell.s33, 0) << "also inside the block, for the air beside it";
    }
}

TEST(FillWindGrid, MakesSoundRecordsOfAnyStress)
{
    std::mt19937 engine(5);
    std::uniform_real_distribution<float> any(-10, 10);
    FlowField flow;
    flow.size = {6, 5, 4};
    flow.cell_m = {1, 1, 1};
    flow.mean.assign(120, {1, 2, 3});
    flow.solid.assign(120, 0);
    for (int i = 0; i < 120; ++i)
    {
        flow.solid[i] = engine() % 4 == 0 ? 1 : 0;
        flow.stress.push_back({any(engine), any(engine), any(engine), any(engine), any(engine), any(engine)});
        if (i % 9 == 0) flow.stress.back() = {};
        flow.c0_eps.push_back(i % 7 == 0 ? 0.0F : std::abs(any(engine)));
    }
    Wind wind;
    fill_wind_grid(flow, wind);
    for (int i = 0; i < 120; ++i)
    {
        const auto* v = reinterpret_cast<const float*>(&wind.cells[i]);
        for (int k = 0; k < 16; ++k) ASSERT_TRUE(std::isfinite(v[k]));
        ASSERT_EQ(wind.cells[i].u, flow.solid[i] != 0 ? 0.0F : 1.0F);
    }
    flow.solid.assign(120, 1);
    fill_wind_grid(flow, wind);
    for (const WindCell& cell : wind.cells) ASSERT_TRUE(std::isfinite(cell.rate1));
}

}  // namespace
}  // namespace spindrift::scene
