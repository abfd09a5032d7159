// SPDX-License-Identifier: MIT
#include "scene/make_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "cpu/wind_projection.h"
#include "scene/distance.h"
#include "tests/scene/temporary_folder.h"

namespace spindrift::scene
{
namespace
{

using ::testing::HasSubstr;

Scene empty_scene(Vec3d min_m, Vec3d max_m)
{
    Scene scene;
    scene.file = std::filesystem::path(SPINDRIFT_SOURCE_DIR) / "scenes" / "test.toml";
    scene.domain.min_m = min_m;
    scene.domain.max_m = max_m;
    scene.capacity = 1000;
    scene.camera.keys = {{0, {0, -10, 2}, {0, 0, 2}}};
    return scene;
}

World world_of(const Scene& scene)
{
    return make_world(scene, read_geometry(scene), cpu::project_wind());
}

bool solid_at(const World& world, Vec3d p)
{
    const VoxelGrid& v = world.voxels;
    const double cell = v.cell_m;
    const int x = static_cast<int>(p.x / cell), y = static_cast<int>(p.y / cell),
              z = static_cast<int>(p.z / cell);
    return v.nx > 0 && v.clearance[GridSize{v.nx, v.ny, v.nz}.index(x, y, z)] == 0;
}

void expect_finite(const std::vector<WindCell>& cells)
{
    const auto* numbers = reinterpret_cast<const float*>(cells.data());
    for (std::size_t i = 0; i < cells.size() * 16; ++i)
        ASSERT_TRUE(std::isfinite(numbers[i])) << "cell " << i / 16 << " number " << i % 16;
}

TEST(MakeWorld, MovesEverythingToTheCornerOfTheDomain)
{
    Scene scene = empty_scene({100, -50, 10}, {120, -30, 30});
    scene.ground.height_m = 12;
    EmitterSettings box;
    box.emitter.shape = EmitterShape::box;
    box.a = {101, -49, 12};
    box.b = {102, -48, 13};
    EmitterSettings sky;
    sky.emitter.shape = EmitterShape::sky;
    sky.b = {30, 30, 20};
    sky.follows = "camera";
    scene.camera.keys = {{1, {110, -60, 14}, {110, -40, 14}}, {3, {110, -40, 14}, {110, -20, 14}}};
    scene.emitters = {box, sky, sky};
    const World world = world_of(scene);
    EXPECT_FLOAT_EQ(world.size_m.x, 20);
    EXPECT_TRUE(world.has_ground);
    EXPECT_FLOAT_EQ(world.ground_m, 2);
    EXPECT_FLOAT_EQ(world.emitters[0].a.x, 1);
    EXPECT_FLOAT_EQ(world.emitters[0].b.y, 2);
    EXPECT_FLOAT_EQ(world.emitters[1].b.x, 30) << "the size of a sky is no place";
    EXPECT_EQ(world.emitters[1].anchor, 0);
    EXPECT_EQ(world.emitters[2].anchor, 0) << "one camera, one anchor";
    ASSERT_EQ(world.anchors.size(), 1U);
    ASSERT_EQ(world.anchors[0].keys.size(), 2U);
    EXPECT_DOUBLE_EQ(world.anchors[0].keys[1].time_s, 3);
    EXPECT_FLOAT_EQ(world.anchors[0].keys[1].position_m.y, 10);
    EXPECT_EQ(world.voxels.nx, 0) << "nothing solid needs no voxels";
}

TEST(MakeWorld, TurnsTheWindToWhereItBlows)
{
    Scene scene = empty_scene({0, 0, 0}, {10, 10, 10});
    scene.wind.source = WindSource::uniform;
    scene.wind.speed_m_s = 5;
    scene.wind.vertical_m_s = -1;
    scene.wind.from_direction_deg = 270;
    World world = world_of(scene);
    EXPECT_NEAR(world.wind.uniform_m_s.x, 5, 1e-6);
    EXPECT_NEAR(world.wind.uniform_m_s.y, 0, 1e-6);
    EXPECT_NEAR(world.wind.uniform_m_s.z, -1, 1e-6);
    scene.wind.from_direction_deg = 0;  // a north wind blows south
    world = world_of(scene);
    EXPECT_NEAR(world.wind.uniform_m_s.y, -5, 1e-6);
}

TEST(MakeWorld, LogarithmicWindHasItsSpeedAtTheReferenceHeight)
{
    Scene scene = empty_scene({0, 0, 0}, {10, 10, 10});
    scene.wind.source = WindSource::logarithmic;
    scene.wind.speed_m_s = 6;
    scene.wind.roughness_m = 0.2;
    const World world = world_of(scene);
    EXPECT_EQ(world.wind.kind, WindKind::logarithmic);
    EXPECT_TRUE(world.wind.turbulent);
    EXPECT_NEAR(world.wind.friction_velocity_m_s / 0.4 * std::log((10 + 0.2) / 0.2), 6, 1e-5);
}

TEST(MakeWorld, BoxesAreExactlyTheirCellsAndKeepTheirSurface)
{
    Scene scene = empty_scene({0, 0, 0}, {20, 20, 20});
    scene.boxes.push_back({{4, 4, 0}, {8, 10, 6}, {Contact::bounce, 0.5F}, {}, {}});
    scene.boxes.push_back({{12, 12, 0}, {14, 14, 2}, {Contact::vanish, 0.3F}, {}, {}});
    scene.boxes.push_back({{16, 16, 0}, {18, 18, 2}, {Contact::bounce, 0.5F}, {}, {}});
    const World world = world_of(scene);
    std::size_t solid = 0;
    for (const auto c : world.voxels.clearance) solid += c == 0 ? 1 : 0;
    EXPECT_EQ(solid, 4U * 6 * 6 + 8 + 8);
    EXPECT_TRUE(solid_at(world, {7.5, 9.5, 5.5}));
    EXPECT_FALSE(solid_at(world, {8.5, 9.5, 5.5}));
    EXPECT_EQ(world.surfaces.size(), 2U);
    const GridSize n{20, 20, 20};
    EXPECT_EQ(world.surfaces[world.voxels.surface[n.index(5, 5, 5)]].contact, Contact::bounce);
    EXPECT_EQ(world.surfaces[world.voxels.surface[n.index(12, 12, 1)]].contact, Contact::vanish);
    EXPECT_EQ(world.voxels.clearance[n.index(9, 5, 3)], 2);
}

TEST(MakeWorld, ThinBoxIsOneCellThick)
{
    Scene scene = empty_scene({0, 0, 0}, {10, 10, 10});
    scene.boxes.push_back({{2, 5.2, 0}, {8, 5.3, 4}, {}, {}, {}});
    const World world = world_of(scene);
    EXPECT_TRUE(solid_at(world, {5, 5.25, 2}));
    EXPECT_FALSE(solid_at(world, {5, 4.5, 2}));
    EXPECT_FALSE(solid_at(world, {5, 6.5, 2}));
}

TEST(MakeWorld, RefusesMoreVoxelsThanMemory)
{
    Scene scene = empty_scene({0, 0, 0}, {1000, 1000, 1000});
    scene.boxes.push_back({{2, 5, 0}, {8, 6, 4}, {}, {}, {}});
    scene.voxel_m = 0.01;
    try
    {
        world_of(scene);
        FAIL() << "made a grid of 1e15 voxels";
    }
    catch (const Error& error)
    {
        EXPECT_THAT(error.what(), HasSubstr("voxels.size_m"));
        EXPECT_THAT(error.what(), HasSubstr("GiB"));
    }
}

TEST(MakeWorld, TownIsSolidWhereItsHousesAreAndOpenInTheStreet)
{
    Scene scene = empty_scene({0, 0, 0}, {160, 160, 50});
    scene.voxel_m = 0.5;
    ModelSettings town;
    town.file = "models/town.obj";
    scene.models = {town};
    const World world = world_of(scene);
    EXPECT_TRUE(solid_at(world, {66, 57, 3})) << "inside the grey flat-roofed house";
    EXPECT_TRUE(solid_at(world, {104, 128, 20})) << "inside the church tower";
    EXPECT_TRUE(solid_at(world, {96, 111 - 8, 2})) << "inside a house of the east row";
    EXPECT_FALSE(solid_at(world, {80, 40, 0.2})) << "the street";
    EXPECT_FALSE(solid_at(world, {72.8, 57, 3})) << "in front of a wall";
    EXPECT_FALSE(solid_at(world, {104, 128, 40})) << "above the spire";
    EXPECT_TRUE(solid_at(world, {74.5, 44, 3})) << "the lamp post";
}

TEST(MakeWorld, FlowsRoundTheTown)
{
    Scene scene = empty_scene({0, 0, 0}, {160, 160, 60});
    ModelSettings town;
    town.file = "models/town.obj";
    scene.models = {town};
    scene.wind.source = WindSource::logarithmic;
    scene.wind.speed_m_s = 6;
    scene.wind.around_solids = true;
    scene.wind.cell_m = 4;
    const World world = world_of(scene);
    ASSERT_EQ(world.wind.kind, WindKind::grid);
    EXPECT_EQ(world.wind.nx, 40);
    EXPECT_EQ(world.wind.nz, 15);
    EXPECT_TRUE(world.wind.turbulent);
    expect_finite(world.wind.cells);
    for (const WindCell& cell : world.wind.cells)
    {
        ASSERT_GT(cell.s11, 0);
        ASSERT_GT(cell.c0_eps, 0);
    }
}

TEST(CameraAt, InterpolatesBetweenKeysAndHoldsAtTheEnds)
{
    Scene scene = empty_scene({10, 0, 0}, {20, 20, 20});
    scene.camera.keys = {{1, {10, 0, 2}, {10, 10, 2}}, {3, {14, 0, 2}, {14, 10, 2}}};
    scene.camera.fov_y_deg = 90;
    EXPECT_FLOAT_EQ(camera_at(scene, 0).eye.x, 0);
    EXPECT_FLOAT_EQ(camera_at(scene, 2).eye.x, 2);
    EXPECT_FLOAT_EQ(camera_at(scene, 9).eye.x, 4);
    EXPECT_NEAR(camera_at(scene, 2).forward.y, 1, 1e-6);
    EXPECT_NEAR(camera_at(scene, 2).right.x, 1, 1e-6);
    EXPECT_NEAR(camera_at(scene, 2).tan_half_fov_y, 1, 1e-6);
}

TEST(CameraAt, AlwaysHasAnOrthonormalBasis)
{
    Scene scene = empty_scene({0, 0, 0}, {20, 20, 20});
    const Vec3d targets[] = {{0, 0, -5}, {0, 0, 5}, {0, 0, 0}, {1e-9, 0, -5}, {3, 4, 12}, {-1, 0, 1e-3}};
    for (const Vec3d& target : targets)
    {
        scene.camera.keys = {{0, {0, 0, 0}, target}};
        const View v = camera_at(scene, 0);
        EXPECT_NEAR(dot(v.right, v.right), 1, 1e-5);
        EXPECT_NEAR(dot(v.up, v.up), 1, 1e-5);
        EXPECT_NEAR(dot(v.forward, v.forward), 1, 1e-5);
        EXPECT_NEAR(dot(v.right, v.up), 0, 1e-5);
        EXPECT_NEAR(dot(v.right, v.forward), 0, 1e-5);
        EXPECT_NEAR(dot(v.up, v.forward), 0, 1e-5);
        const Vec3f made = cross(v.right, v.up);
        EXPECT_NEAR(dot(made, v.forward), -1, 1e-5) << "right-handed: x right, y up, looking along -z";
        EXPECT_GE(v.up.z, -1e-6);
    }
}

TEST(VehicleAt, IsLinearBetweenItsKeys)
{
    VehicleSettings vehicle;
    vehicle.path.keys = {{0, {10, 0, 0}}, {2, {20, 0, 1}}};
    DomainSettings domain;
    domain.min_m = {5, 0, 0};
    EXPECT_FLOAT_EQ(vehicle_at(vehicle, domain, 1).x, 10);
    EXPECT_FLOAT_EQ(vehicle_at(vehicle, domain, 1).z, 0.5F);
    EXPECT_FLOAT_EQ(vehicle_at(vehicle, domain, 5).x, 15);
}

TEST(MakeWorld, PutsGustsAndVehiclesOnTheGridOfTheWind)
{
    const std::string text = R"([domain]
min_m = [100, 0, 0]
max_m = [140, 40, 20]
[particles]
capacity = 10
[wind]
source = "log"
speed_m_s = 6
around_solids = true
[wind.gusts]
speed_m_s = 2
length_m = 30
seed = 9
[[vehicle]]
name = "truck"
body_m = [8, 2.5, 3]
[[vehicle.key]]
position_m = [110, 20, 0]
[[vehicle.key]]
time_s = 2
position_m = [130, 20, 0]
[[box]]
min_m = [118, 18, 0]
max_m = [122, 22, 6]
[[camera.key]]
eye_m = [0, -10, 2]
look_at_m = [5, 5, 2]
)";
    const Wind wind = world_of(parse_scene(text, "s.toml")).wind;
    EXPECT_FLOAT_EQ(wind.gusts.speed_m_s, 2);
    EXPECT_FLOAT_EQ(wind.gusts.length_m, 30);
    EXPECT_EQ(wind.gusts.seed, 9U);
    EXPECT_NEAR(wind.gusts.carried_m_s.x, 6, 1) << "the mean at the reference height";
    ASSERT_EQ(wind.bodies.size(), 1U);
    EXPECT_FLOAT_EQ(wind.bodies[0].path.keys[1].position_m.x, 30) << "local frame";
    EXPECT_FLOAT_EQ(wind.bodies[0].size_m.y, 2.5F);
    ASSERT_EQ(wind.gust_share.size(), wind.cells.size());
    const GridSize n{wind.nx, wind.ny, wind.nz};
    EXPECT_EQ(wind.gust_share[n.index(10, 10, 0)], 0) << "in the house";
    EXPECT_GT(wind.gust_share[n.index(10, 10, 6)], wind.gust_share[n.index(10, 8, 1)]) << "beside a wall";
    EXPECT_TRUE(wind.changes());
}

TEST(MakeWorld, ReadsARealWindField)
{
    const auto winds = optional_data("qes/TwoBuildings_windsWk.nc");
    if (winds.empty())
        GTEST_SKIP() << "no qes/TwoBuildings_windsWk.nc: set SPINDRIFT_TEST_DATA to a folder that holds it";
    Scene scene = empty_scene({0, 0, 0}, {300, 180, 208});
    scene.voxel_m = 4;
    scene.wind.source = WindSource::file;
    scene.wind.winds_file = std::filesystem::absolute(winds);
    for (const char* turbulence : {"", "qes/TwoBuildings_turbOut.nc"})
    {
        scene.wind.turbulence_file =
            *turbulence == 0 ? std::filesystem::path() : std::filesystem::absolute(optional_data(turbulence));
        const World world = world_of(scene);
        const Wind& wind = world.wind;
        ASSERT_EQ(wind.kind, WindKind::grid);
        EXPECT_TRUE(wind.turbulent);
        EXPECT_EQ(wind.nx, 75);
        EXPECT_EQ(wind.ny, 45);
        EXPECT_EQ(wind.nz, 52);
        EXPECT_FLOAT_EQ(wind.origin_m.x, 2);
        EXPECT_FLOAT_EQ(wind.origin_m.z, 2);
        expect_finite(wind.cells);
        // the blocks: 32 x 32 x 32 m at (72, 76) and 32 x 32 x 96 m at (136, 76)
        EXPECT_TRUE(solid_at(world, {74, 78, 2}));
        EXPECT_TRUE(solid_at(world, {102, 106, 30}));
        EXPECT_FALSE(solid_at(world, {102, 106, 34}));
        EXPECT_TRUE(solid_at(world, {138, 78, 94}));
        EXPECT_FALSE(solid_at(world, {138, 78, 98}));
        EXPECT_FALSE(solid_at(world, {70, 78, 2}));
        EXPECT_FALSE(solid_at(world, {106, 78, 2}));
        std::size_t solid = 0;
        for (const auto c : world.voxels.clearance) solid += c == 0 ? 1 : 0;
        EXPECT_EQ(solid, 8U * 8 * 8 + 8U * 8 * 24);
        // power law 4.32 m/s at 96 m, p = 0.21, upwind of both blocks
        const GridSize n{75, 45, 52};
        for (const int k : {5, 12, 23})
        {
            const double height = 4 * (k + 0.5), expected = 4.32 * std::pow(height / 96, 0.21);
            const WindCell& cell = wind.cells[n.index(1, 5, k)];
            EXPECT_NEAR(cell.u, expected, 0.1 * expected) << height << " m";
            EXPECT_NEAR(cell.v, 0, 0.3);
        }
        EXPECT_EQ(wind.cells[n.index(20, 22, 2)].u, 0) << "still inside a block";
        EXPECT_GT(wind.cells[n.index(20, 22, 2)].s11, 0) << "but with the turbulence of the air beside it";
    }
}

TEST(MakeWorld, RefusesADomainThatTheWindFileDoesNotCover)
{
    const auto winds = optional_data("qes/TwoBuildings_windsWk.nc");
    if (winds.empty())
        GTEST_SKIP() << "no qes/TwoBuildings_windsWk.nc: set SPINDRIFT_TEST_DATA to a folder that holds it";
    Scene scene = empty_scene({0, 0, 0}, {400, 180, 208});
    scene.wind.source = WindSource::file;
    scene.wind.winds_file = std::filesystem::absolute(winds);
    EXPECT_THROW(world_of(scene), Error);
}

}  // namespace
}  // namespace spindrift::scene
