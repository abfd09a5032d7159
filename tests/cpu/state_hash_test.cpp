// SPDX-License-Identifier: MIT
#include <cmath>

#include <gtest/gtest.h>

#include "worlds.h"

namespace spindrift::cpu::test
{
namespace
{

constexpr std::uint64_t kCapacity = 9000;
constexpr int kSteps = 150;

std::uint64_t hash_after(const World& world, CpuOptions options, int steps = kSteps)
{
    TestRun run(world, options);
    run.steps(steps);
    return run->state_hash();
}

TEST(StateHash, IsTheSameForAnyNumberOfThreads)
{
    for (const OnLeave rule : {OnLeave::remove, OnLeave::respawn, OnLeave::wrap})
    {
        const World world = world_with_everything(kCapacity, rule, true);
        const std::uint64_t one = hash_after(world, {1, Simd::automatic});
        EXPECT_EQ(one, hash_after(world, {2, Simd::automatic}));
        EXPECT_EQ(one, hash_after(world, {7, Simd::automatic}));
    }
}

TEST(StateHash, IsTheSameForEveryInstructionSet)
{
    for (const bool turbulent : {true, false})
    {
        const World world = world_with_everything(kCapacity, OnLeave::respawn, turbulent);
        const std::uint64_t scalar = hash_after(world, {2, Simd::scalar});
        for (const Simd simd : available_simd())
            EXPECT_EQ(scalar, hash_after(world, {2, simd})) << simd_name(simd);
    }
}

TEST(StateHash, IsTheSameForAnyThreadsAndInstructionSetInAWindThatChanges)
{
    const World world = world_with_changing_wind(kCapacity);
    const std::uint64_t scalar = hash_after(world, {1, Simd::scalar});
    for (const Simd simd : available_simd())
        EXPECT_EQ(scalar, hash_after(world, {3, simd})) << simd_name(simd);
    TestRun first(world);
    first.steps(40);  // in the middle of the first change
    TestRun second(world);
    second->restore(first->save());
    second.steps(kSteps - 40);
    EXPECT_EQ(scalar, second->state_hash()) << "a snapshot finds its wind again";
}

TEST(StateHash, IsTheSameForEveryInstructionSetInAnalyticWinds)
{
    for (const WindKind kind : {WindKind::uniform, WindKind::logarithmic})
    {
        World world = world_with_everything(kCapacity, OnLeave::wrap, true);
        world.wind.kind = kind;
        world.wind.uniform_m_s = {3, -1, 0.2F};
        world.wind.friction_velocity_m_s = 0.4F;
        world.wind.to_x = 0.6F, world.wind.to_y = 0.8F;
        const std::uint64_t scalar = hash_after(world, {2, Simd::scalar});
        for (const Simd simd : available_simd())
            EXPECT_EQ(scalar, hash_after(world, {2, simd})) << simd_name(simd);
    }
}

TEST(StateHash, ChangesWithAnyBitOfAnyFlake)
{
    TestRun run(world_with_everything(kCapacity, OnLeave::remove, true));
    run.steps(3);
    const std::uint64_t before = run->state_hash();
    for (float* array : {run.flakes.x, run.flakes.q3, run.flakes.slip_z})
    {
        const float value = array[17];
        array[17] = std::nextafter(value, 1000.0F);
        EXPECT_NE(before, run->state_hash());
        array[17] = value;
    }
    std::swap(run.flakes.x[5], run.flakes.x[6]);
    EXPECT_NE(before, run->state_hash());
    std::swap(run.flakes.x[5], run.flakes.x[6]);
    EXPECT_EQ(before, run->state_hash());
}

TEST(StateHash, DependsOnTheSeed)
{
    World world = world_with_everything(kCapacity, OnLeave::remove, true);
    const std::uint64_t first = hash_after(world, {}, 5);
    world.seed = 7;
    EXPECT_NE(first, hash_after(world, {}, 5));
}

TEST(Snapshot, RestoredRunsGoOnWithTheSameHashes)
{
    const World world = world_with_everything(kCapacity, OnLeave::respawn, true);
    TestRun first(world, {2, Simd::automatic});
    first.steps(60);
    first->set_anchor(0, {18, 16, 9});
    const Snapshot saved = first->save();
    TestRun second(world, {1, Simd::scalar});
    second.steps(5);
    second->restore(saved);
    EXPECT_EQ(first->state_hash(), second->state_hash());
    EXPECT_EQ(second->step_number(), 60U);
    for (int i = 0; i < 80; ++i)
    {
        first->step();
        second->step();
        ASSERT_EQ(first->state_hash(), second->state_hash()) << "step " << first->step_number();
    }
}

}  // namespace
}  // namespace spindrift::cpu::test
