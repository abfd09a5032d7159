// SPDX-License-Identifier: MIT
// Row 6: walls. Nothing inside a solid, nothing lost, however far a step goes.
#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "core/encounter.h"
#include "core/walk.h"
#include "tests/stress/tracers.h"

namespace spindrift::stress
{
namespace
{

using Solid = std::function<bool(int, int, int)>;

/// A closed box of 12 m, its solids bounce; the wind blows at 30 m/s aslant into all of it.
World closed_box(const Solid& inside, double dt, float restitution)
{
    World w = tracer_world(600, {12, 12, 12}, dt);
    w.voxels = cpu::test::voxels(
        12, 12, 12, 1,
        [&](int x, int y, int z)
        {
            const bool border = x == 0 || y == 0 || z == 0 || x == 11 || y == 11 || z == 11;
            return border || inside(x, y, z);
        },
        [](int, int, int) { return std::uint8_t{0}; });
    w.surfaces = {{Contact::bounce, restitution}};
    w.wind = even_air({4, 0.5, -0.8, 3, 0.2, 2}, 3);
    WindCell& c = w.wind.cells[0];
    c.u = 30, c.v = -11, c.w = 0.01F;  // grazes the floor
    return w;
}

TEST(Walls, HoldInSlotsCornersAndWedges)
{
    const std::pair<const char*, Solid> shapes[] = {
        {"empty", [](int, int, int) { return false; }},
        {"slots of one cell", [](int x, int, int) { return x % 2 == 0; }},
        {"shafts of one cell", [](int x, int y, int) { return x % 2 == 0 || y % 2 == 0; }},
        {"single cells", [](int x, int y, int z) { return x % 2 == 0 || y % 2 == 0 || z % 2 == 0; }},
        {"corners", [](int x, int y, int z) { return (x + y + z) % 4 == 0; }},
        {"wedge", [](int x, int y, int) { return x + y > 12; }},
        {"touching edges", [](int x, int y, int) { return (x / 2 + y / 2) % 2 == 0; }}};
    for (const auto& [name, inside] : shapes)
        for (const double dt : {1e-4, 0.05, 1.0, 10.0})
            for (const float restitution : {0.0F, 1.0F})
            {
                const World w = closed_box(inside, dt, restitution);
                TestRun run(w);
                run->step();
                const FlakeCounts first = run->counts();
                ASSERT_GT(first.alive, 10U) << name;
                for (int i = 0; i < 12; ++i)
                {
                    run->step();
                    ASSERT_EQ(misplaced(w, run), 0U) << name << ", dt = " << dt;
                }
                const FlakeCounts c = run->counts();
                ASSERT_EQ(c.alive, first.alive) << name << ", dt = " << dt << ": lost";
                ASSERT_EQ(c.emitted, c.alive + c.vanished) << name;
                ASSERT_EQ(run->extent().rogue, 0U) << name << ", dt = " << dt;
            }
}

/// Air that flows round a block: in long steps, too, flakes go with it, where whole steps would run into the
/// block. Counted are those that touch it.
TEST(Walls, DoNotCatchWhatFlowsRoundThemInLongSteps)
{
    const auto caught = [](double dt)
    {
        // potential flow round a cylinder of 3 m under a block of 4 x 4 m
        World w = tracer_world(2000, {40, 24, 12}, dt);
        w.on_leave = OnLeave::remove;
        w.voxels = cpu::test::voxels(
            40, 24, 12, 1, [](int x, int y, int) { return x >= 18 && x < 22 && y >= 10 && y < 14; },
            [](int, int, int) { return std::uint8_t{0}; });
        w.surfaces = {{Contact::land, 0}};
        w.emitters[0].a = {1, 9, 4}, w.emitters[0].b = {2, 15, 8};
        w.wind = cpu::test::grid_wind(81, 49, 1, {0, 0, 0}, {0.5F, 0.5F, 1},
                                      [](float px, float py, float)
                                      {
                                          const float x = px - 20, y = py - 12,
                                                      r2 = std::max(x * x + y * y, 4.0F);
                                          WindCell c{};
                                          c.u = 8 * (1 - 9 * (x * x - y * y) / (r2 * r2));
                                          c.v = 8 * (-18 * x * y) / (r2 * r2);
                                          c.w = fall_speed();
                                          return c;
                                      });
        w.wind.turbulent = false;
        TestRun run(w);
        run.steps(static_cast<int>(std::ceil(6 / dt)));
        return run->counts().landed;
    };
    const std::uint64_t truth = caught(0.01);
    EXPECT_LE(truth, 40U);
    EXPECT_LE(caught(1.0), truth + 80);
    EXPECT_LE(caught(2.5), truth + 160);
}

/// Between two walls the place after any way is its fold: the path has kept its length.
TEST(Walls, KeepTheLengthOfThePath)
{
    World w = tracer_world(1, {12, 12, 12}, 1);
    w.voxels = cpu::test::voxels(
        12, 12, 12, 1, [](int x, int, int) { return x < 3 || x > 5; },
        [](int, int, int) { return std::uint8_t{0}; });
    w.surfaces = {{Contact::bounce, 1}};
    VoxelWalker<double> walk(solids_view(w));
    for (int i = 0; i < 200; ++i)
    {
        const double start = 3.01 + 0.0147 * i, way = std::pow(-1.31, i % 24);
        const WalkResult<double> end = walk({start, 6, 6}, {way, 0.3, -0.2});
        const double turns = (start + way - 3) / 6;
        const double folded = 6 * std::abs(turns - std::round(turns)) + 3;
        ASSERT_NEAR(end.end.x, folded, 1e-9) << "way of " << way;
        ASSERT_NEAR(end.end.y, 6.3, 1e-12);
        ASSERT_EQ(end.bounces, static_cast<int>(std::abs(std::floor((start + way - 3) / 3))));
    }
}

/// Also where a border lies behind the wall, within the reach of the same path.
TEST(Walls, KeepTheLengthOfAPathThatABorderIsBehind)
{
    World w = tracer_world(1, {12, 12, 12}, 1);
    w.voxels = cpu::test::voxels(
        12, 12, 12, 1, [](int x, int, int) { return x < 3 || x > 5; },
        [](int, int, int) { return std::uint8_t{0}; });
    w.surfaces = {{Contact::bounce, 1}};
    const Region region{{0, 0, 0}, w.size_m, false};
    Surroundings around;
    around.solids = solids_view(w);
    around.regions = &region;
    for (const float way : {-7.0F, 7.0F, -20.0F, 33.0F, -100.0F})
    {
        Encounter f;
        f.x = {3.75F, 6, 6}, f.path = {way, 0.5F, 0};
        f.air = {};
        EncounterTally tally;
        EncounterResolver{around, 1, 0, 0, false, false}(f, tally);
        const double turns = (3.75 + static_cast<double>(way) - 3) / 6;
        ASSERT_EQ(tally.left, 0U) << way;
        EXPECT_NEAR(f.x.x, 6 * std::abs(turns - std::round(turns)) + 3, 0.01) << way;  // rounding off faces
        EXPECT_NEAR(f.x.y, 6.5, 1e-3) << way;
    }
}

}  // namespace
}  // namespace spindrift::stress
