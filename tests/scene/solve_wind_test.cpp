// SPDX-License-Identifier: MIT
#include "scene/solve_wind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "cpu/wind_projection.h"
#include "tests/scene/small_scene.h"
#include "tests/scene/temporary_folder.h"

namespace spindrift::scene
{
namespace
{

using ::testing::HasSubstr;

Footprint box(Vec3d low, Vec3d high)
{
    return {{{low, {high.x, low.y, 0}, high, {low.x, high.y, 0}}}, low.z, high.z, 0};
}

/// Boxes on a plain, one voxel a metre.
struct Plain
{
    Vec3d size_m;
    VoxelGrid voxels;
    Surroundings around;

    Plain(Vec3d size, const std::vector<Footprint>& boxes, bool named = true) : size_m(size)
    {
        voxels.nx = static_cast<int>(size.x), voxels.ny = static_cast<int>(size.y),
        voxels.nz = static_cast<int>(size.z);
        const GridSize n{voxels.nx, voxels.ny, voxels.nz};
        voxels.clearance.assign(n.count(), 1);
        for (const Footprint& b : boxes)
            for (int z = static_cast<int>(b.base_m); z < b.top_m; ++z)
                for (int y = static_cast<int>(b.outlines[0][0].y); y < b.outlines[0][2].y; ++y)
                    for (int x = static_cast<int>(b.outlines[0][0].x); x < b.outlines[0][2].x; ++x)
                        voxels.clearance[n.index(x, y, z)] = 0;
        around = {size, 0, [](double, double) { return 0.0; }, {}, &voxels};
        if (named) around.boxes = boxes;
    }
    Plain(const Plain&) = delete;
    Plain& operator=(const Plain&) = delete;

    SolvedWind solve(const WindSettings& settings, const std::filesystem::path& cache = {}) const
    {
        return solve_wind(settings, around, cpu::project_wind(), cache);
    }
};

WindSettings west_wind(double cell_m)
{
    WindSettings settings;
    settings.source = WindSource::solve;
    settings.speed_m_s = 5;
    settings.cell_m = cell_m;
    return settings;
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

TEST(UrbanZones, HaveTheLengthsOfTheirFormulas)
{
    const BlockSize<double> cube{10, 10, 10};
    EXPECT_NEAR(cavity_length(cube), 18 / 1.24, 1e-9);
    EXPECT_NEAR(upwind_length(cube), 15 / 1.8, 1e-9);
    EXPECT_NEAR(separation_scale(cube), 10, 1e-9);
    EXPECT_NEAR(cavity_length(BlockSize<double>{10, 20, 5}), 1.8 * 20 / (std::pow(0.5, 0.3) * 1.48), 1e-9);
    EXPECT_NEAR(cavity_length(BlockSize<double>{1, 50, 50}), 1.8 * 10 / (std::pow(3, 0.3) * 3.4), 1e-9)
        << "held";
    EXPECT_NEAR(separation_scale(BlockSize<double>{8, 27, 1}), 4 * 3, 1e-9);
    EXPECT_EQ(cavity_speed(0.0, 5.0), -1);
    EXPECT_EQ(cavity_speed(5.0, 5.0), 0);
    EXPECT_NEAR(wake_speed(12.0, 4.0), 1 - std::pow(3, -1.5), 1e-12);
    EXPECT_EQ(ellipsoid(0.0, 0.0), 1);
    EXPECT_EQ(ellipsoid(1.2, 0.5), 0) << "beside the block";
}

TEST(UrbanZones, ACanyonTurnsDownAtItsFarWall)
{
    EXPECT_NEAR(canyon_speed(0.0, 8.0).up, 0.5, 1e-12);
    EXPECT_NEAR(canyon_speed(8.0, 8.0).up, -0.5, 1e-12);
    EXPECT_NEAR(canyon_speed(4.0, 8.0).up, 0, 1e-12);
    EXPECT_NEAR(canyon_speed(4.0, 8.0).along, -1, 1e-12);
    EXPECT_NEAR(canyon_speed(0.0, 8.0).along, 0, 1e-12);
    EXPECT_NEAR(canyon_speed(2.0, 8.0).along, canyon_speed(6.0, 8.0).along, 1e-12);
}

TEST(WindBlock, IsMeasuredAcrossTheWind)
{
    const Footprint house = box({10, 20, 0}, {20, 26, 8});
    const WindBlock along(house, {1, 0, 0}, 0.5);
    EXPECT_NEAR(along.size().width, 6, 1e-9);
    EXPECT_NEAR(along.size().length, 10, 1e-9);
    EXPECT_EQ(along.size().height, 8);
    EXPECT_TRUE(along.square());
    EXPECT_NEAR(along.strip(23).front, 10, 1e-9);
    EXPECT_NEAR(along.strip(23).lee, 20, 1e-9);
    EXPECT_FALSE(along.strip(26.1).any());
    EXPECT_FALSE(along.strip(19.9).any());

    const double c = std::sqrt(0.5);
    const WindBlock oblique(house, {c, c, 0}, 0.1);
    EXPECT_NEAR(oblique.size().width, 16 * c, 1e-9);
    EXPECT_NEAR(oblique.size().length, 16 * c, 1e-9);
    EXPECT_FALSE(oblique.square());
    // the south-western corner is at t = 10 c, where the front begins; the lee there is the eastern wall
    const double corner = oblique.t({10, 20, 0});
    EXPECT_NEAR(oblique.strip(corner).front, 30 * c, 0.15);
    EXPECT_NEAR(oblique.strip(oblique.t({20, 26, 0})).lee, 46 * c, 0.15);
}

TEST(InflowProfile, FollowsItsLaw)
{
    WindSettings settings = west_wind(2);
    EXPECT_NEAR(InflowProfile(settings).at(10).x, 5, 1e-12);
    EXPECT_NEAR(InflowProfile(settings).at(3).x, 5 * std::log(31.0) / std::log(101.0), 1e-12);
    EXPECT_EQ(InflowProfile(settings).at(0).x, 0);
    EXPECT_EQ(InflowProfile(settings).at(-3).x, 0);
    settings.profile = InflowKind::power;
    settings.from_direction_deg = 180;
    settings.exponent = 0.25;
    EXPECT_NEAR(InflowProfile(settings).at(160).y, 10, 1e-12);
    EXPECT_NEAR(InflowProfile(settings).at(160).x, 0, 1e-12);
    settings.profile = InflowKind::measured;
    settings.levels = {{10, 4, 270}, {40, 8, 180}};
    const InflowProfile measured(settings);
    EXPECT_NEAR(measured.at(10).x, 4, 1e-12);
    EXPECT_NEAR(measured.at(40).y, 8, 1e-12);
    EXPECT_NEAR(measured.at(900).y, 8, 1e-12) << "holds above";
    EXPECT_NEAR(measured.at(1).x, 4 * std::log(11.0) / std::log(101.0), 1e-12);
    const double half = std::sqrt(10.1 * 40.1) - 0.1;  // middle of the logarithms
    EXPECT_NEAR(measured.at(half).x, 2, 1e-9);
    EXPECT_NEAR(measured.at(half).y, 4, 1e-9);
}

TEST(SolveWind, ReattachesBehindACubeWhereTunnelsFindIt)
{
    // Cubes in deep boundary layers: 1.4 to 1.6 heights behind the lee wall (Castro and Robins 1977;
    // Martinuzzi and Tropea 1993)
    const Plain plain({160, 100, 60}, {box({50, 40, 0}, {70, 60, 20})});
    const SolvedWind solved = plain.solve(west_wind(2));
    EXPECT_EQ(solved.blocks, 1U);
    const StaggeredWind& wind = solved.wind;
    EXPECT_LE(largest_divergence(wind), 1e-6 * 10 / 2);
    int back = 35;
    while (back < 80 && wind.centre(back, 25, 0).x < 0) ++back;
    EXPECT_GE(2 * (back - 35), 1.3 * 20);
    EXPECT_LE(2 * (back - 35), 1.7 * 20);
    EXPECT_LT(wind.centre(37, 25, 2).x, -0.5) << "recirculates";
    EXPECT_GT(wind.centre(37, 25, 14).x, 4) << "above the cavity";
    EXPECT_LT(wind.centre(35 + 18, 25, 3).x, 0.9 * wind.centre(35 + 18, 5, 3).x) << "wake";
    EXPECT_LT(wind.centre(28, 25, 10).x, 0.35 * wind.centre(28, 3, 10).x)
        << "separates from the front edge of the roof";
    EXPECT_LT(wind.centre(23, 25, 2).x, 0.6 * wind.centre(23, 3, 2).x) << "upwind";
    for (int z = 1; z < 30; ++z)  // far off it is the profile
        EXPECT_NEAR(wind.centre(1, 2, z).x, 5 * std::log((2 * z + 1 + 0.1) / 0.1) / std::log(101.0), 0.25);
    for (int x = 0; x < 80; ++x)  // symmetric across the wind
        for (int y = 0; y < 25; ++y) ASSERT_NEAR(wind.centre(x, y, 4).x, wind.centre(x, 49 - y, 4).x, 2e-3);
    int cells[8] = {};
    for (const WindZone zone : solved.zone) ++cells[static_cast<int>(zone)];
    EXPECT_EQ(cells[static_cast<int>(WindZone::building)], 10 * 10 * 10);
    for (const WindZone zone : {WindZone::upwind, WindZone::cavity, WindZone::wake, WindZone::separated})
        EXPECT_GT(cells[static_cast<int>(zone)], 20) << static_cast<int>(zone);
    EXPECT_EQ(cells[static_cast<int>(WindZone::canyon)], 0);
}

TEST(SolveWind, TurnsWithTheDirection)
{
    const Plain plain({60, 60, 40}, {box({24, 24, 0}, {36, 36, 14})});
    WindSettings settings = west_wind(2);
    const StaggeredWind from_west = plain.solve(settings).wind;
    settings.from_direction_deg = 180;
    const StaggeredWind from_south = plain.solve(settings).wind;
    settings.from_direction_deg = 360;
    const StaggeredWind from_north = plain.solve(settings).wind;
    for (int z = 0; z < 20; ++z)
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 30; ++x)
            {
                ASSERT_NEAR(from_west.centre(x, y, z).x, from_south.centre(y, x, z).y, 2e-3);
                ASSERT_NEAR(from_west.centre(x, y, z).z, from_south.centre(y, x, z).z, 2e-3);
                ASSERT_NEAR(from_west.centre(x, y, z).x, -from_north.centre(y, 29 - x, z).y, 2e-3);
            }
}

TEST(SolveWind, ACanyonBetweenTwoHousesTurnsOver)
{
    const Plain plain({100, 60, 40}, {box({30, 15, 0}, {40, 45, 12}), box({50, 15, 0}, {60, 45, 12})});
    const SolvedWind solved = plain.solve(west_wind(1));
    EXPECT_EQ(solved.zone[solved.wind.size.index(45, 30, 5)], WindZone::canyon);
    EXPECT_LT(solved.wind.centre(45, 30, 1).x, 0) << "back along the street's floor";
    EXPECT_GT(solved.wind.centre(41, 30, 6).z, 0) << "up the lee wall";
    EXPECT_LT(solved.wind.centre(48, 30, 6).z, 0) << "down the other one";
}

TEST(SolveWind, FindsTheSameBlockAmongVoxels)
{
    const std::vector<Footprint> boxes{box({20, 20, 0}, {30, 32, 10})};
    const Plain named({60, 50, 30}, boxes), voxels({60, 50, 30}, boxes, false);
    const SolvedWind one = named.solve(west_wind(2)), other = voxels.solve(west_wind(2));
    EXPECT_EQ(other.blocks, 1U);
    ASSERT_EQ(one.wind.u.size(), other.wind.u.size());
    for (std::size_t i = 0; i < one.wind.u.size(); ++i)
        ASSERT_NEAR(one.wind.u[i], other.wind.u[i], 2e-3) << i;
}

TEST(SolveWind, GoesUpAndDownWithTheGround)
{
    Plain plain({80, 40, 40}, {});
    plain.around.ground_m = [](double x, double) { return 10 * std::exp(-0.01 * (x - 40) * (x - 40)); };
    const GridSize n{80, 40, 40};
    for (int z = 0; z < 12; ++z)
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 80; ++x)
                if (z + 0.5 < plain.around.ground_m(x + 0.5, 0)) plain.voxels.clearance[n.index(x, y, z)] = 0;
    const SolvedWind solved = plain.solve(west_wind(2));
    EXPECT_EQ(solved.blocks, 0U) << "a hill is no block";
    EXPECT_EQ(solved.zone[solved.wind.size.index(20, 10, 1)], WindZone::terrain);
    EXPECT_GT(solved.wind.centre(14, 10, 3).z, 0.2) << "up the windward slope";
    EXPECT_LT(solved.wind.centre(25, 10, 3).z, -0.2) << "down the other one";
    EXPECT_GT(solved.wind.centre(20, 10, 6).x, solved.wind.centre(1, 10, 6).x) << "faster over the top";
}

TEST(SolveWind, SolvesOnGrowingLayersAndGivesEvenOnes)
{
    const Plain plain({60, 60, 60}, {box({24, 24, 0}, {36, 36, 14})});
    WindSettings settings = west_wind(2);
    const SolvedWind even = plain.solve(settings);
    settings.layer_m = 1;
    settings.layer_growth = 1.1;
    const SolvedWind grown = plain.solve(settings);
    const double layer = grown.wind.layer_m.front();
    EXPECT_NEAR(layer, 1, 0.1);
    for (const double l : grown.wind.layer_m) ASSERT_EQ(l, layer);
    EXPECT_NEAR(layer * grown.wind.size.nz, 60, 1e-9);
    EXPECT_EQ(grown.zone.size(), grown.wind.size.count());
    EXPECT_LE(largest_divergence(grown.wind), 1e-6 * 10);
    for (const int x : {5, 20, 27})
        EXPECT_NEAR(grown.wind.centre(x, 15, static_cast<int>(21 / layer)).x, even.wind.centre(x, 15, 10).x,
                    0.5)
            << x;
}

TEST(SolveWind, TakesCalmAirAndNothingButSolid)
{
    const Plain full({12, 12, 12}, {box({0, 0, 0}, {12, 12, 12})});
    for (const double v : full.solve(west_wind(2)).wind.u) ASSERT_EQ(v, 0);
    WindSettings calm = west_wind(2);
    calm.speed_m_s = 0;
    const Plain plain({12, 12, 12}, {box({4, 4, 0}, {8, 8, 6})});
    for (const double v : plain.solve(calm).wind.u) ASSERT_EQ(v, 0);
}

TEST(SolveWind, KeepsWhatItSolvedByContent)
{
    const TemporaryFolder folder;
    const Plain plain({40, 40, 30}, {box({14, 14, 0}, {22, 26, 10})});
    WindSettings settings = west_wind(2);
    const SolvedWind first = plain.solve(settings, folder / "cache"),
                     second = plain.solve(settings, folder / "cache");
    EXPECT_FALSE(first.from_cache);
    EXPECT_TRUE(second.from_cache);
    EXPECT_EQ(first.cached, second.cached);
    EXPECT_EQ(first.wind.u, second.wind.u);
    EXPECT_EQ(first.wind.v, second.wind.v);
    EXPECT_EQ(first.wind.w, second.wind.w);
    settings.speed_m_s = 5.0001;
    EXPECT_FALSE(plain.solve(settings, folder / "cache").from_cache);
    const auto files = std::distance(std::filesystem::directory_iterator(folder / "cache"), {});
    EXPECT_EQ(files, 2) << "two winds and nothing half written";
    std::filesystem::resize_file(first.cached, 1000);
    settings.speed_m_s = 5;
    try
    {
        plain.solve(settings, folder / "cache");
        FAIL();
    }
    catch (const Error& error)
    {
        EXPECT_THAT(error.what(), HasSubstr("delete it"));
    }
}

TEST(SolveWind, IsDescribedBySceneFiles)
{
    const Scene scene =
        parse(with("[wind]\nsource = \"solve\"\nprofile = \"measured\"\nlayer_m = 0.5\nlayer_growth = 1.1\n"
                   "cell_m = 1\nzones = false\n[[wind.level]]\nheight_m = 2\nspeed_m_s = 3\n"
                   "[[wind.level]]\nheight_m = 20\nspeed_m_s = 6\nfrom_direction_deg = 200\n"));
    EXPECT_EQ(scene.wind.source, WindSource::solve);
    EXPECT_TRUE(scene.wind.turbulence);
    EXPECT_FALSE(scene.wind.zones);
    ASSERT_EQ(scene.wind.levels.size(), 2U);
    EXPECT_EQ(scene.wind.levels[1].from_direction_deg, 200);
    const std::string solve = "[wind]\nsource = \"solve\"\n";
    EXPECT_THAT(error_of(with(solve)), HasSubstr("speed_m_s"));
    EXPECT_THAT(error_of(with(solve + "profile = \"measured\"\n")), HasSubstr("level"));
    EXPECT_THAT(error_of(with(solve + "profile = \"measured\"\nspeed_m_s = 4\n")), HasSubstr("speed_m_s"));
    EXPECT_THAT(error_of(with(solve + "speed_m_s = 4\nlayer_growth = 2\n")), HasSubstr("1.3"));
    EXPECT_THAT(error_of(with(solve + "speed_m_s = 4\nexponent = 0.2\n")), HasSubstr("profile = \"power\""));
    EXPECT_THAT(error_of(with(solve + "speed_m_s = 4\naround_solids = true\n")),
                HasSubstr("source = \"log\""));
    EXPECT_THAT(error_of(with(solve + "profile = \"measured\"\n[[wind.level]]\nheight_m = 9\nspeed_m_s = 3\n"
                                      "[[wind.level]]\nheight_m = 2\nspeed_m_s = 3\n")),
                HasSubstr("low to high"));
    EXPECT_THAT(error_of(with("[wind]\nsource = \"calm\"\ncache_folder = \"x\"\n")),
                HasSubstr("source = \"solve\""));
}

}  // namespace
}  // namespace spindrift::scene
