// SPDX-License-Identifier: MIT
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/error.h"
#include "worlds.h"

namespace spindrift::cpu::test
{
namespace
{

void expect_balance(const TestRun& run)
{
    const FlakeCounts c = run->counts();
    ASSERT_EQ(c.emitted, c.alive + c.left + c.landed + c.vanished) << "step " << run->step_number();
    ASSERT_EQ(c.alive, recount_alive(run)) << "step " << run->step_number();
    for (std::size_t i = 1; i < run->slots_used(); ++i)
        ASSERT_LT(run.flakes.id[i - 1], run.flakes.id[i]) << "slot " << i << ", step " << run->step_number();
}

TEST(Counts, BalanceAtEveryStepInRandomWorlds)
{
    std::mt19937 random(42);
    const auto pick = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
    for (int trial = 0; trial < 12; ++trial)
    {
        World w = world_with_everything(500 + pick(9000), static_cast<OnLeave>(pick(3)), pick(2) == 0);
        w.seed = random();
        w.step_s = 0.01 * (1 + pick(30));
        w.has_ground = pick(2) == 0;
        for (Emitter& e : w.emitters)
        {
            e.rate_per_s = 0.37 * pick(5000);
            e.burst = pick(2000);
        }
        TestRun run(w, {static_cast<int>(1 + pick(3)), Simd::automatic});
        for (int step = 0; step < 40; ++step)
        {
            run->step();
            expect_balance(run);
            if (HasFatalFailure()) return;
        }
        EXPECT_EQ(misplaced(w, run), 0U) << "trial " << trial;
        EXPECT_GT(run->counts().left + run->counts().landed + run->counts().vanished, 0U);
    }
}

World still_box(std::uint64_t capacity)
{
    World w;
    w.size_m = {10, 10, 10};
    w.capacity = capacity;
    w.has_ground = false;
    return w;
}

TEST(Emission, WithholdsWhatHasNoRoom)
{
    World w = still_box(100);
    Emitter e;
    e.a = {5, 5, 9};
    e.rate_per_s = 600;  // ten a step
    w.emitters.push_back(e);
    TestRun run(w);
    run.steps(15);
    EXPECT_EQ(run->counts().emitted, 100U);
    EXPECT_EQ(run->counts().alive, 100U);
    EXPECT_EQ(run->counts().withheld, 50U);
    EXPECT_EQ(run->slots_used(), 100U);
}

TEST(Emission, MakesExactlyTheRateInTheLongRun)
{
    World w = still_box(4000);
    w.step_s = 0.013;
    Emitter e;
    e.a = {5, 5, 9};
    e.rate_per_s = 777.7;
    w.emitters.push_back(e);
    TestRun run(w);
    run.steps(300);
    EXPECT_EQ(run->counts().emitted, static_cast<std::uint64_t>(777.7 * 0.013 * 300));
}

TEST(Emission, RespawnKeepsTheNumberInTheAir)
{
    World w = still_box(2000);
    w.wind.uniform_m_s = {20, 3, 0};
    Emitter e;
    e.shape = EmitterShape::box;
    e.b = w.size_m;
    e.burst = 2000;
    w.emitters.push_back(e);
    TestRun run(w);
    run->step();
    for (int step = 1; step < 100; ++step)
    {
        const FlakeCounts before = run->counts();
        run->step();
        expect_balance(run);
        // every flake that has left so far has come back by the end of the next step
        ASSERT_EQ(run->counts().emitted, 2000 + before.left);
    }
    EXPECT_GT(run->counts().left, 5000U);
    EXPECT_EQ(run->counts().withheld, 0U);
}

TEST(Sky, KeepsItsFlakesInItsBoxWhereverTheAnchorGoes)
{
    World w = world_with_everything(4000, OnLeave::remove, true);
    w.voxels = {};
    w.has_ground = false;
    w.emitters.erase(w.emitters.begin(), w.emitters.end() - 1);
    TestRun run(w);
    const auto expect_inside = [&](Vec3f centre)
    {
        ASSERT_EQ(run->counts().alive, 1500U);
        for (std::size_t i = 0; i < run->slots_used(); ++i)
        {
            ASSERT_LE(std::abs(run.flakes.x[i] - centre.x), 6.001F);
            ASSERT_LE(std::abs(run.flakes.y[i] - centre.y), 6.001F);
            ASSERT_LE(std::abs(run.flakes.z[i] - centre.z), 6.001F);
        }
    };
    run.steps(15);  // 0.5 s
    expect_inside({22, 15, 8});
    run->set_anchor(0, {500, -300, 40});  // the sky knows no border of the world
    run.steps(3);
    expect_inside({500, -300, 40});
    EXPECT_EQ(run->counts().emitted, 1500U);
}

TEST(Sky, ReplacesWhatFellOnTheGroundFromItsTop)
{
    World w = still_box(1000);
    w.has_ground = true;
    Emitter e;
    e.shape = EmitterShape::sky;
    e.a = {5, 5, 4}, e.b = {8, 8, 8};
    e.burst = 1000;
    w.emitters.push_back(e);
    TestRun run(w);
    run.steps(400);
    const FlakeCounts c = run->counts();
    EXPECT_GT(c.landed, 200U);
    EXPECT_EQ(c.left, 0U);
    EXPECT_NEAR(static_cast<double>(c.alive), 1000.0,
                30.0);  // those that landed in the newest step are still owed
    EXPECT_EQ(misplaced(w, run), 0U);
}

TEST(Walls, HoldAtAnyStepLength)
{
    for (const double step_s : {0.2, 2.0, 10.0})
    {
        World w = world_with_everything(2000, OnLeave::wrap, true);
        w.step_s = step_s;
        for (Surface& s : w.surfaces) s = {Contact::bounce, 0.8F};
        TestRun run(w);
        for (int i = 0; i < 30; ++i)
        {
            run->step();
            ASSERT_EQ(misplaced(w, run), 0U) << "step of " << step_s << " s";
        }
        expect_balance(run);
    }
}

TEST(Hostile, NothingIsEverNotANumber)
{
    for (const WindKind kind : {WindKind::uniform, WindKind::logarithmic, WindKind::grid})
        for (const double step_s : {1e-6, 10.0, 1000.0})
        {
            World w = world_with_everything(3000, OnLeave::wrap, true);
            w.wind.kind = kind;
            w.step_s = step_s;
            w.wind.friction_velocity_m_s = 0;  // calm: no stress at all
            for (std::size_t i = 0; i < w.wind.cells.size(); ++i)
            {
                if (i % 3 == 0) w.wind.cells[i] = WindCell{};
                if (i % 7 == 0) w.wind.cells[i].c0_eps = 1e9F;
                if (i % 11 == 0) w.wind.cells[i].gradient = 1e6F;
            }
            TestRun run(w);
            run.steps(8);
            EXPECT_EQ(misplaced(w, run), 0U);
            for (std::size_t i = 0; i < run->slots_used(); ++i)
                for (const float* a : {run.flakes.q1, run.flakes.q2, run.flakes.q3, run.flakes.slip_x,
                                       run.flakes.slip_y, run.flakes.slip_z})
                    ASSERT_TRUE(std::isfinite(a[i]));
        }
}

TEST(World, ThatContradictsItselfIsRefused)
{
    World w = world_with_everything(100, OnLeave::wrap, true);
    w.wind.cells.pop_back();
    EXPECT_THROW(TestRun{w}, Error);
    w = world_with_everything(100, OnLeave::wrap, true);
    w.voxels.surface.back() = 200;
    w.voxels.clearance.back() = 0;
    EXPECT_THROW(TestRun{w}, Error);
    w = world_with_everything(100, OnLeave::wrap, true);
    w.emitters.front().anchor = 3;
    EXPECT_THROW(TestRun{w}, Error);
    w = world_with_everything(100, OnLeave::wrap, true);
    w.step_s = 0;
    EXPECT_THROW(TestRun{w}, Error);
    TestRun run(world_with_everything(100, OnLeave::wrap, true));
    EXPECT_THROW(run->set_anchor(1, {0, 0, 0}), Error);
    EXPECT_THROW(run->set_anchor(0, {NAN, 0, 0}), Error);
}

}  // namespace
}  // namespace spindrift::cpu::test
