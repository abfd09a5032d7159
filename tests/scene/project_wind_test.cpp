// SPDX-License-Identifier: MIT
#include "scene/project_wind.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "cpu/wind_projection.h"

namespace spindrift::scene
{
namespace
{

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
    const StaggeredWind wind = wind_around_solids(log_profile(), {40, 40, 40}, 2, {}, cpu::project_wind());
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
    EXPECT_THROW(wind_around_solids(profile, {40, 40, 40}, 2, {}, cpu::project_wind()), Error);
}

TEST(CloseFromShear, IsTheSurfaceLayerInALogarithmicWind)
{
    const Wind profile = log_profile();
    FlowField flow =
        cell_means(wind_around_solids(profile, {20, 20, 60}, 2, {}, cpu::project_wind()), {0, 0, 0});
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
    FlowField flow =
        cell_means(wind_around_solids(wind, {40, 40, 40}, 2, voxels, cpu::project_wind()), {0, 0, 0});
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
    for (const WindCell& cell : wind.cells) ASSERT_TRUE(std::isfinite(cell.c0_eps));
}

}  // namespace
}  // namespace spindrift::scene
