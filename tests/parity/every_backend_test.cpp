// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/gradient_reach.h"
#include "tests/cpu/worlds.h"
#include "tests/parity/backends.h"

namespace spindrift::parity
{

namespace
{

using cpu::test::world_with_everything;

View camera()
{
    View v;
    v.eye = {-15, 12, 9};
    v.forward = {0.96F, 0.28F, 0}, v.right = {0.28F, -0.96F, 0}, v.up = {0, 0, 1};
    v.tan_half_fov_y = 0.3F;
    v.width_px = 640, v.height_px = 360, v.guard_px = 40;
    v.near_m = 12, v.far_m = 60;
    return v;
}

void expect_same(const FlakeCounts& a, const FlakeCounts& b)
{
    EXPECT_EQ(a.emitted, b.emitted);
    EXPECT_EQ(a.alive, b.alive);
    EXPECT_EQ(a.left, b.left);
    EXPECT_EQ(a.landed, b.landed);
    EXPECT_EQ(a.vanished, b.vanished);
    EXPECT_EQ(a.withheld, b.withheld);
}

/// One body for every variant; the CPU, scalar and on one thread, is the oracle.
class EveryBackend : public testing::TestWithParam<Variant>
{
  protected:
    void SetUp() override
    {
        const std::string why = cannot_run_because();
        if (why.empty()) return;
        const char* required = std::getenv("SPINDRIFT_REQUIRE_CUDA");
        if (required != nullptr && std::string_view(required) == "1") FAIL() << why;
        GTEST_SKIP() << why;
    }

    std::unique_ptr<BackendRun> make(const World& world) const { return GetParam().make(world); }

    /// Steps both and compares hash and counts every `between` steps.
    void expect_parity(const World& world, int steps, int between) const
    {
        const auto tested = make(world);
        const auto oracle = make_oracle(world);
        for (int done = 0; done < steps;)
        {
            for (int i = 0; i < between; ++i, ++done)
            {
                tested->backend().step();
                oracle->backend().step();
            }
            tested->backend().finish();
            expect_same(tested->backend().counts(), oracle->backend().counts());
            ASSERT_EQ(tested->backend().state_hash(), oracle->backend().state_hash()) << "step " << done;
        }
    }

    /// Ids of a list in its order, beside their keys.
    static std::vector<std::uint64_t> keyed_ids(BackendRun& run, const DrawList& list)
    {
        const std::vector<std::uint32_t> ids = run.ids();
        std::vector<std::uint64_t> result = run.pairs(list);
        for (std::uint64_t& pair : result)
            pair = (pair & ~std::uint64_t{0xFFFFFFFFU}) | ids[pair & 0xFFFFFFFFU];
        return result;
    }

    static void expect_same_lists(BackendRun& tested, BackendRun& oracle, const View& view,
                                  const SortSettings& sort)
    {
        const DrawList a = tested.backend().prepare(view, sort);
        const DrawList b = oracle.backend().prepare(view, sort);
        EXPECT_EQ(a.culled, b.culled);
        EXPECT_EQ(a.sorted, b.sorted);
        ASSERT_EQ(keyed_ids(tested, a), keyed_ids(oracle, b)) << sort.depth_bits << " bits";
    }
};

TEST_P(EveryBackend, MovesFlakesAsTheOracleDoes)
{
    for (const OnLeave rule : {OnLeave::remove, OnLeave::respawn, OnLeave::wrap})
        for (const bool turbulent : {true, false})
            expect_parity(world_with_everything(6000, rule, turbulent), 40, 10);
}

TEST_P(EveryBackend, MovesFlakesAsTheOracleDoesWhereStepsAreCut)
{
    World world = world_with_everything(1000, OnLeave::respawn, true);
    for (WindCell& cell : world.wind.cells) cell.gradient *= 7;
    ASSERT_EQ(relaxations(world), 2);
    expect_parity(world, 20, 10);
}

TEST_P(EveryBackend, MovesFlakesAsTheOracleDoesInAnalyticWinds)
{
    for (const WindKind kind : {WindKind::uniform, WindKind::logarithmic})
        for (const bool turbulent : {true, false})
        {
            World world = world_with_everything(3000, OnLeave::wrap, turbulent);
            world.wind.kind = kind;
            world.wind.uniform_m_s = {3, -1, 0.2F};
            world.wind.friction_velocity_m_s = 0.4F;
            world.wind.to_x = 0.6F, world.wind.to_y = 0.8F;
            expect_parity(world, 20, 10);
        }
}

/// Inertia, crossing trajectories and drift, in steps that need dice for the last place, that are as usual,
/// and that are cut before walls.
TEST_P(EveryBackend, MovesHeavyAndDriftingFlakesAsTheOracleDoes)
{
    for (const double step_s : {1e-4, 1.0 / 30, 0.3})
        for (const bool turbulent : {true, false})
        {
            World world = world_with_everything(3000, OnLeave::respawn, turbulent);
            world.step_s = step_s;
            world.snow.inertia = true;
            world.snow.crossing = 1.5F;
            world.grains = lifted_law(grain_law(0.05));
            Emitter drift;
            drift.shape = EmitterShape::drift;
            drift.a = {5, 5, 0.5F}, drift.b = {20, 9, 4};
            drift.radius_m = 0.05F, drift.lift_m_s = 0.3F;
            drift.rate_per_s = 30 / step_s;
            drift.burst = 200;
            world.emitters.push_back(drift);
            expect_parity(world, 4, 2);
        }
}

/// Room for so many flakes: at the ends of warps, blocks and tiles.
TEST_P(EveryBackend, MovesFlakesAsTheOracleDoesInAWindThatChanges)
{
    expect_parity(cpu::test::world_with_changing_wind(3000), 60, 20);
}

TEST_P(EveryBackend, HoldsAtEverySize)
{
    for (const std::uint64_t capacity :
         {0, 1, 31, 32, 33, 255, 256, 257, 1023, 1024, 1025, 4095, 4096, 4097, 7919})
    {
        SCOPED_TRACE(capacity);
        World world = world_with_everything(capacity, OnLeave::respawn, true);
        for (Emitter& emitter : world.emitters)
            emitter.burst = capacity / 3, emitter.rate_per_s = static_cast<double>(capacity);
        const auto tested = make(world);
        const auto oracle = make_oracle(world);
        for (int i = 0; i < 4; ++i) tested->backend().step(), oracle->backend().step();
        ASSERT_EQ(tested->backend().state_hash(), oracle->backend().state_hash());
        expect_same_lists(*tested, *oracle, camera(), {"auto", 32});
    }
}

TEST_P(EveryBackend, ListsTheVisibleFromFarToNearAndTiesInOrderOfEmission)
{
    const World world = world_with_everything(6000, OnLeave::respawn, true);
    const auto tested = make(world);
    const auto oracle = make_oracle(world);
    for (int i = 0; i < 15; ++i) tested->backend().step(), oracle->backend().step();
    for (const int bits : {32, 24, 16}) expect_same_lists(*tested, *oracle, camera(), {"auto", bits});
    View tied = camera();
    tied.far_m = 1e6F;  // buckets of 15 m
    expect_same_lists(*tested, *oracle, tied, {"auto", 16});
    EXPECT_FALSE(tested->backend().prepare(camera(), {"none", 32}).sorted);
}

/// Flakes get other slots where holes are closed and where they are re-ordered; the order that a sort over
/// frames keeps goes with them.
TEST_P(EveryBackend, GoesOnWithTheOrderOfTheLastFrameWhenSlotsChange)
{
    const World world = world_with_everything(4000, OnLeave::respawn, true);
    const auto tested = make(world);
    const auto oracle = make_cpu_run(world, 1, GetParam().reorder_every_steps);
    for (const char* sort : {"bitonic-passes", "odd-even-passes"})
    {
        int moved = 0, unsorted = 0;
        for (int frame = 0; frame < 6; ++frame)
        {
            const std::vector<std::uint32_t> before = oracle->ids();
            for (int i = 0; i < 3; ++i) tested->backend().step(), oracle->backend().step();
            const std::vector<std::uint32_t> after = oracle->ids();
            moved += !std::equal(before.begin(), before.begin() + std::min(before.size(), after.size()),
                                 after.begin());
            const SortSettings settings{sort, 32, 3};
            expect_same_lists(*tested, *oracle, camera(), settings);
            const auto list = oracle->pairs(oracle->backend().prepare(camera(), settings));
            unsorted += !std::is_sorted(list.begin(), list.end());
            tested->backend().prepare(camera(), settings);
        }
        EXPECT_GT(moved, 1) << sort << ": no slot changed, so nothing was tested";
        EXPECT_GT(unsorted, 3) << sort << ": each frame began anew";
    }
}

TEST_P(EveryBackend, ListsNothingWhereNothingIsSeen)
{
    const auto tested = make(world_with_everything(3000, OnLeave::wrap, true));
    for (int i = 0; i < 3; ++i) tested->backend().step();
    View away = camera();
    away.forward = {-0.96F, -0.28F, 0}, away.right = {-0.28F, 0.96F, 0};
    const DrawList list = tested->backend().prepare(away, {"auto", 32});
    tested->backend().finish();
    EXPECT_EQ(list.count, 0U);
    EXPECT_EQ(list.culled, tested->backend().counts().alive);
}

TEST_P(EveryBackend, RefusesASortThatItHasNot)
{
    const auto tested = make(world_with_everything(100, OnLeave::wrap, true));
    EXPECT_THROW(tested->backend().prepare(camera(), {"bogo", 32}), Error);
    EXPECT_THROW(tested->backend().prepare(camera(), {"auto", 17}), Error);
}

TEST_P(EveryBackend, GoesOnFromASnapshotOfAnother)
{
    const World world = world_with_everything(6000, OnLeave::respawn, true);
    const auto tested = make(world);
    const auto oracle = make_oracle(world);
    for (int i = 0; i < 30; ++i) tested->backend().step(), oracle->backend().step();
    tested->backend().set_anchor(0, {18, 16, 9});
    oracle->backend().set_anchor(0, {18, 16, 9});
    const Snapshot from_tested = tested->backend().save();
    const Snapshot from_oracle = oracle->backend().save();
    EXPECT_EQ(from_tested.emitter_state, from_oracle.emitter_state);
    const auto second = make(world);
    second->backend().step();
    second->backend().restore(from_oracle);
    const auto third = make_oracle(world);
    third->backend().restore(from_tested);
    for (int i = 0; i < 30; ++i)
        for (BackendRun* run : {tested.get(), oracle.get(), second.get(), third.get()}) run->backend().step();
    const std::uint64_t hash = oracle->backend().state_hash();
    EXPECT_EQ(tested->backend().state_hash(), hash);
    EXPECT_EQ(second->backend().state_hash(), hash);
    EXPECT_EQ(third->backend().state_hash(), hash);
}

TEST_P(EveryBackend, RefusesASnapshotOfAnotherWorld)
{
    const auto saved = make_oracle(world_with_everything(300, OnLeave::wrap, true))->backend().save();
    EXPECT_THROW(make(world_with_everything(300, OnLeave::remove, true))->backend().restore(saved), Error);
}

TEST_P(EveryBackend, MeasuresWhereItsFlakesAre)
{
    const World world = world_with_everything(6000, OnLeave::remove, true);
    const auto tested = make(world);
    const auto oracle = make_oracle(world);
    for (int i = 0; i < 20; ++i) tested->backend().step(), oracle->backend().step();
    const FlakeExtent a = tested->backend().extent();
    const FlakeExtent b = oracle->backend().extent();
    EXPECT_EQ(a.rogue, 0U);
    for (const auto& [corner, other] : {std::pair(a.lower, b.lower), std::pair(a.upper, b.upper)})
    {
        EXPECT_EQ(corner.x, other.x);
        EXPECT_EQ(corner.y, other.y);
        EXPECT_EQ(corner.z, other.z);
    }
    EXPECT_LT(a.lower.x, a.upper.x);
}

TEST_P(EveryBackend, CountsFlakesThatRanAwayAndKeepsThemOutOfTheList)
{
    const auto tested = make(world_with_everything(3000, OnLeave::wrap, true));
    for (int i = 0; i < 2; ++i) tested->backend().step();
    tested->put(&FlakeView::x, 3, std::numeric_limits<float>::quiet_NaN());
    tested->put(&FlakeView::z, 4, std::numeric_limits<float>::infinity());
    tested->put(&FlakeView::q2, 5, 11);
    EXPECT_EQ(tested->backend().extent().rogue, 3U);
    EXPECT_TRUE(std::isfinite(tested->backend().extent().upper.z));
    View all = camera();
    all.near_m = 0, all.far_m = 1e6F, all.tan_half_fov_y = 100;
    const DrawList list = tested->backend().prepare(all, {"auto", 16});
    for (const std::uint64_t pair : tested->pairs(list))
        EXPECT_THAT(pair & 0xFFFFFFFFU, testing::AllOf(testing::Ne(3U), testing::Ne(4U)));
}

TEST_P(EveryBackend, OutlivesFlakesThatAreNotANumber)
{
    const World world = world_with_everything(2000, OnLeave::wrap, true);
    const auto tested = make(world);
    const auto oracle = make_oracle(world);
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                         std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity(),
                         3e38F,
                         -3e38F,
                         1e-45F};
    for (int i = 0; i < 8; ++i)
    {
        tested->backend().step(), oracle->backend().step();
        if (i > 0 || GetParam().name.find("Reordered") != std::string::npos) continue;
        std::size_t slot = 7;
        for (const float value : bad)
            for (float* FlakeView::*array :
                 {&FlakeView::x, &FlakeView::z, &FlakeView::q1, &FlakeView::slip_y})
                for (BackendRun* run : {tested.get(), oracle.get()})
                    run->put(array, slot, value), slot += run == oracle.get();
    }
    tested->backend().finish();
    expect_same(tested->backend().counts(), oracle->backend().counts());
    const FlakeCounts c = tested->backend().counts();
    EXPECT_EQ(c.emitted, c.alive + c.left + c.landed + c.vanished);
}

INSTANTIATE_TEST_SUITE_P(Variants, EveryBackend, testing::ValuesIn(variants()),
                         [](const auto& variant) { return variant.param.name; });

}  // namespace

}  // namespace spindrift::parity
