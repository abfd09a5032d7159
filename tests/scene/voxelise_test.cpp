// SPDX-License-Identifier: MIT
#include "scene/voxelise.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <random>

#include "scene/triangle_cells.h"

namespace spindrift::scene
{
namespace
{

TEST(ChebyshevDistance, IsTheDistanceToTheNearestSolidCell)
{
    std::mt19937 engine(1);
    for (const GridSize n : {GridSize{1, 1, 1}, GridSize{7, 1, 3}, GridSize{9, 8, 7}, GridSize{1, 12, 5}})
        for (int solids = 0; solids < 4; ++solids)
        {
            std::vector<std::uint8_t> cells(n.count(), 1);
            for (int i = 0; i < solids; ++i) cells[engine() % cells.size()] = 0;
            const std::vector<std::uint8_t> given = cells;
            chebyshev_distance(n, cells);
            for (int z = 0; z < n.nz; ++z)
                for (int y = 0; y < n.ny; ++y)
                    for (int x = 0; x < n.nx; ++x)
                    {
                        int nearest = 255;
                        for (int k = 0; k < n.nz; ++k)
                            for (int j = 0; j < n.ny; ++j)
                                for (int i = 0; i < n.nx; ++i)
                                    if (given[n.index(i, j, k)] == 0)
                                        nearest = std::min(
                                            nearest,
                                            std::max({std::abs(i - x), std::abs(j - y), std::abs(k - z)}));
                        ASSERT_EQ(cells[n.index(x, y, z)], nearest);
                    }
        }
}

TEST(ChebyshevDistance, StopsAt255)
{
    std::vector<std::uint8_t> cells(400, 1);
    cells[0] = 0;
    chebyshev_distance({400, 1, 1}, cells);
    EXPECT_EQ(cells[254], 254);
    EXPECT_EQ(cells[300], 255);
}

TEST(EuclideanDistance, IsTheDistanceBetweenCentres)
{
    std::mt19937 engine(2);
    const GridSize n{9, 7, 5};
    const Vec3d cell{1, 2, 0.5};
    for (int solids = 0; solids < 5; ++solids)
    {
        std::vector<std::uint8_t> solid(n.count(), 0);
        for (int i = 0; i < solids; ++i) solid[engine() % solid.size()] = 1;
        const std::vector<float> d = euclidean_distance(n, cell, solid);
        for (int z = 0; z < n.nz; ++z)
            for (int y = 0; y < n.ny; ++y)
                for (int x = 0; x < n.nx; ++x)
                {
                    double nearest = std::numeric_limits<double>::infinity();
                    for (int k = 0; k < n.nz; ++k)
                        for (int j = 0; j < n.ny; ++j)
                            for (int i = 0; i < n.nx; ++i)
                                if (solid[n.index(i, j, k)] != 0)
                                    nearest = std::min(nearest, std::sqrt(std::pow((i - x) * cell.x, 2) +
                                                                          std::pow((j - y) * cell.y, 2) +
                                                                          std::pow((k - z) * cell.z, 2)));
                    if (std::isinf(nearest))
                        ASSERT_TRUE(std::isinf(d[n.index(x, y, z)]));
                    else
                        ASSERT_NEAR(d[n.index(x, y, z)], nearest, 1e-5 * (1 + nearest));
                }
    }
}

/// Whether a triangle reaches into a unit cell, by clipping it against the six faces: another way than the
/// separating axes.
bool clips_into(std::vector<Vec3d> polygon, const Vec3d& low, double slack)
{
    const auto component = [](const Vec3d& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; };
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0})
        {
            const double limit =
                sign > 0 ? component(low, axis) + 1 + slack : -(component(low, axis) - slack);
            std::vector<Vec3d> kept;
            for (std::size_t i = 0; i < polygon.size(); ++i)
            {
                const Vec3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                const double da = limit - sign * component(a, axis), db = limit - sign * component(b, axis);
                if (da >= 0) kept.push_back(a);
                if ((da >= 0) != (db >= 0)) kept.push_back(a + (b - a) * (da / (da - db)));
            }
            polygon = kept;
        }
    return !polygon.empty();
}

TEST(TriangleCells, AgreeWithClipping)
{
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> place(0, 6);
    int touched = 0;
    for (int trial = 0; trial < 300; ++trial)
    {
        std::array<Vec3d, 3> p;
        for (Vec3d& corner : p) corner = {place(engine), place(engine), place(engine)};
        if (trial % 3 == 0) p[1] = p[0] + (p[1] - p[0]) * 0.01;  // needles
        if (trial % 5 == 0) p[0].z = p[1].z = p[2].z;            // level
        const TriangleCells triangle(p[0], p[1], p[2]);
        const Vec3d low = triangle.low(), high = triangle.high();
        for (int z = static_cast<int>(low.z); z <= static_cast<int>(high.z); ++z)
            for (int y = static_cast<int>(low.y); y <= static_cast<int>(high.y); ++y)
                for (int x = static_cast<int>(low.x); x <= static_cast<int>(high.x); ++x)
                {
                    const Vec3d cell{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
                    const std::vector<Vec3d> corners(p.begin(), p.end());
                    const bool touches = triangle.touches(x, y, z);
                    touched += touches ? 1 : 0;
                    ASSERT_TRUE(touches || !clips_into(corners, cell, -1e-9)) << "trial " << trial;
                    ASSERT_TRUE(!touches || clips_into(corners, cell, 1e-9)) << "trial " << trial;
                }
    }
    EXPECT_GT(touched, 1000);
}

/// A box as triangles with its fronts outwards; `sides` says which of its six sides are there (-x +x -y +y -z
/// +z).
Mesh box(Vec3f a, Vec3f b, std::array<bool, 6> sides = {true, true, true, true, true, true})
{
    Mesh mesh;
    for (int bits = 0; bits < 8; ++bits)
        mesh.vertices.push_back(
            {{(bits & 1) != 0 ? b.x : a.x, (bits & 2) != 0 ? b.y : a.y, (bits & 4) != 0 ? b.z : a.z},
             {0, 0, 1}});
    static constexpr std::uint32_t corners[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                                    {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    MeshPart& part = mesh.parts.emplace_back();
    for (std::size_t s = 0; s < 6; ++s)
        if (sides[s])
            part.indices.insert(part.indices.end(), {corners[s][0], corners[s][1], corners[s][2],
                                                     corners[s][0], corners[s][2], corners[s][3]});
    return mesh;
}

std::size_t count(const VoxelGrid& grid)
{
    std::size_t n = 0;
    for (const auto c : grid.clearance) n += c == 0 ? 1 : 0;
    return n;
}

VoxelGrid voxels_of(const Mesh& mesh, Voxeliser::Height floor = {}, double cell_m = 0.5)
{
    Voxeliser v({10, 10, 10}, cell_m, std::move(floor));
    v.add_mesh(mesh, 0);
    return v.finish();
}

TEST(Voxeliser, ClosedModelOnCellBordersFillsExactlyItsCells)
{
    const VoxelGrid grid = voxels_of(box({2, 3, 4}, {5, 5, 8}));
    EXPECT_EQ(count(grid), 6U * 4 * 8);
    const GridSize n{20, 20, 20};
    EXPECT_EQ(grid.clearance[n.index(4, 6, 8)], 0);
    EXPECT_EQ(grid.clearance[n.index(9, 9, 15)], 0);
    EXPECT_EQ(grid.clearance[n.index(6, 7, 11)], 0) << "the inside";
    EXPECT_EQ(grid.clearance[n.index(3, 6, 8)], 1);
}

TEST(Voxeliser, ClosedModelBetweenBordersTakesEveryCellItTouches)
{
    EXPECT_EQ(count(voxels_of(box({2.1F, 3.1F, 4.1F}, {4.9F, 4.9F, 7.9F}))), 6U * 4 * 8);
}

TEST(Voxeliser, OpenModelIsAShell)
{
    const VoxelGrid grid = voxels_of(box({2, 3, 4}, {5, 5, 8}, {true, true, true, true, true, false}));
    EXPECT_LT(count(grid), 6U * 4 * 8);
    EXPECT_GT((grid.clearance[GridSize{20, 20, 20}.index(6, 7, 11)]), 0) << "air in the box without a lid";
}

TEST(Voxeliser, HouseWithoutFloorIsSolidOnTheGround)
{
    const std::array<bool, 6> no_floor{true, true, true, true, false, true};
    const auto ground = [](double, double) { return 0.0; };
    EXPECT_EQ(count(voxels_of(box({2, 3, 0}, {5, 5, 8}, no_floor), ground)), 6U * 4 * 16);
    EXPECT_LT(count(voxels_of(box({2, 3, 0}, {5, 5, 8}, no_floor))), 6U * 4 * 16)
        << "without a ground air comes in from below";
    const auto slope = [](double x, double) { return 0.5 * x; };
    const VoxelGrid grid = voxels_of(box({2, 3, 0.5F}, {5, 5, 8}, no_floor), slope);
    EXPECT_EQ((grid.clearance[GridSize{20, 20, 20}.index(8, 8, 12)]), 0) << "the inside, on a slope";
}

TEST(Voxeliser, ModelCutByTheDomainStaysSolid)
{
    const VoxelGrid grid = voxels_of(box({-20, 2, -20}, {5, 8, 30}));
    EXPECT_EQ(count(grid), 10U * 12 * 20);
}

TEST(Voxeliser, SphereHasItsVolume)
{
    Mesh mesh;
    constexpr int kRings = 32, kSides = 64;
    for (int i = 0; i <= kRings; ++i)
        for (int j = 0; j < kSides; ++j)
        {
            const double a = M_PI * i / kRings, b = 2 * M_PI * j / kSides;
            const auto f = [](double v) { return static_cast<float>(v); };
            mesh.vertices.push_back({{f(5 + 3 * std::sin(a) * std::cos(b)),
                                      f(5 + 3 * std::sin(a) * std::sin(b)), f(5 + 3 * std::cos(a))},
                                     {}});
        }
    MeshPart& part = mesh.parts.emplace_back();
    for (std::uint32_t i = 0; i < kRings; ++i)
        for (std::uint32_t j = 0; j < kSides; ++j)
        {
            const std::uint32_t a = i * kSides + j, b = i * kSides + (j + 1) % kSides;
            part.indices.insert(part.indices.end(), {a, a + kSides, b, b, a + kSides, b + kSides});
        }
    const double cell = 0.1,
                 volume = static_cast<double>(count(voxels_of(mesh, {}, cell))) * cell * cell * cell;
    const double sphere = 4.0 / 3 * M_PI * 27;
    EXPECT_GT(volume, sphere * 0.99) << "every cell that it touches";
    EXPECT_LT(volume, sphere * std::pow((3 + cell * std::sqrt(3.0)) / 3, 3))
        << "and none farther than a cell's diagonal";
}

TEST(Voxeliser, FillsColumnsUnderAHeightField)
{
    Voxeliser v({10, 10, 10}, 1, {});
    v.add_height_field([](double x, double) { return x; }, 3);
    const VoxelGrid grid = v.finish();
    EXPECT_EQ(count(grid), 10U * (0 + 1 + 2 + 3 + 4 + 5 + 6 + 7 + 8 + 9));
    EXPECT_EQ((grid.surface[GridSize{10, 10, 10}.index(5, 0, 0)]), 3);
}

TEST(Voxeliser, IsFastEnoughForATown)
{
    Voxeliser v({160, 160, 50}, 0.5, [](double, double) { return 0.0; });
    for (int i = 0; i < 10; ++i)
        v.add_mesh(box({5.0F + 15.0F * static_cast<float>(i), 10, 0},
                       {15.0F + 15.0F * static_cast<float>(i), 150, 20}),
                   0);
    const auto start = std::chrono::steady_clock::now();
    const VoxelGrid grid = v.finish();
    const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    RecordProperty("distance_of_10M_voxels_s", std::to_string(s));
    EXPECT_EQ(grid.clearance.size(), 320U * 320 * 100);
}

}  // namespace
}  // namespace spindrift::scene
