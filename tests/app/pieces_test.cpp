// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/frame_clock.h"
#include "app/plan_log.h"
#include "app/progress_bar.h"
#include "app/run_report.h"
#include "app/stage_log.h"

namespace spindrift::app
{

namespace
{

TEST(FrameClock, NeverDrifts)
{
    const FrameClock clock{0, 30, 1.0 / 60};
    for (std::uint64_t k = 0; k < 1000000; k += 997) EXPECT_EQ(clock.steps_before(k), 2 * k);
}

TEST(FrameClock, StepsDoNotFollowTheFrameRate)
{
    // 25 frames a second over steps of 1/60 s: 2.4 steps a frame, whole ones only.
    const FrameClock clock{1, 25, 1.0 / 60};
    EXPECT_EQ(clock.steps_before(0), 60U);
    EXPECT_EQ(clock.steps_before(1), 62U);
    EXPECT_EQ(clock.steps_before(2), 64U);
    EXPECT_EQ(clock.steps_before(3), 67U);
    EXPECT_EQ(clock.steps_before(25), 120U);
}

TEST(FrameClock, LongStepsLastOverSeveralFrames)
{
    const FrameClock clock{0, 100, 0.1};
    EXPECT_EQ(clock.steps_before(9), 0U);
    EXPECT_EQ(clock.steps_before(10), 1U);
}

TEST(Quantile, IsTheNearestRank)
{
    std::vector<float> samples;
    for (int i = 100; i >= 1; --i) samples.push_back(static_cast<float>(i));
    EXPECT_EQ(quantile(samples, 0.5), 50);
    EXPECT_EQ(quantile(samples, 0.95), 95);
    EXPECT_EQ(quantile(samples, 1), 100);
    EXPECT_EQ(quantile({3}, 0.5), 3);
    EXPECT_EQ(quantile({}, 0.5), 0);
}

TEST(StageLog, KeepsStagesInOrderOfFirstMention)
{
    StageLog log;
    for (double ms : {3.0, 1.0, 2.0}) log.add("sort", ms);
    log.add("cull", 7);
    const auto summaries = log.summaries();
    ASSERT_EQ(summaries.size(), 2U);
    EXPECT_EQ(summaries[0].name, "sort");
    EXPECT_EQ(summaries[0].samples, 3U);
    EXPECT_EQ(summaries[0].median_ms, 2);
    EXPECT_EQ(summaries[0].total_ms, 6);
    EXPECT_EQ(log.newest()[0].second, 2);
}

TEST(PlanLog, CountsRunsAndKeepsEachReasonOnce)
{
    PlanLog log;
    gl::FramePlan plan;
    plan.passes = {{"sort", true, "over-blending of 7 flakes", "", "", {}}};
    log.add(plan);
    plan.passes[0].reason = "over-blending of 19 flakes";
    log.add(plan);
    plan.passes = {{"sort", false, "at rest", "", "", {}}};
    log.add(plan);
    ASSERT_EQ(log.passes().size(), 1U);
    EXPECT_EQ(log.passes()[0].ran, 2U);
    EXPECT_EQ(log.passes()[0].skipped, 1U);
    EXPECT_THAT(log.passes()[0].ran_because, testing::ElementsAre("over-blending of 7 flakes"));
    EXPECT_THAT(log.passes()[0].skipped_because, testing::ElementsAre("at rest"));
}

TEST(PlanLog, CountsWhatTheGpuFoundNeedless)
{
    PlanLog log;
    gl::FramePlan plan;
    plan.passes = {{"bloom", true, "spreads light", "", "", {}}};
    log.add(plan);
    log.add(plan);
    log.left_out_after_all("bloom", "nothing was bright");
    EXPECT_EQ(log.passes()[0].ran, 1U);
    EXPECT_EQ(log.passes()[0].skipped, 1U);
    EXPECT_THAT(log.passes()[0].ran_because, testing::ElementsAre("spreads light"));
    log.add(plan);
    log.left_out_after_all("bloom", "nothing was bright");
    log.add(plan);
    log.left_out_after_all("bloom", "nothing was bright");
    EXPECT_EQ(log.passes()[0].ran, 1U);
    EXPECT_EQ(log.passes()[0].skipped, 3U);
    EXPECT_THAT(log.passes()[0].skipped_because, testing::ElementsAre("nothing was bright"));
}

TEST(ProgressLine, TellsRateAndTimeLeft)
{
    EXPECT_EQ(progress_line("frames", 30, 90, 10),
              "30/90 frames [==========>                   ] 3.0 frames/s, 20 s left");
    EXPECT_THAT(progress_line("frames", 90, 90, 10), testing::HasSubstr("[==============================]"));
    EXPECT_THAT(progress_line("frames", 1, 1000, 10), testing::HasSubstr("2 h 46 min left"));
    EXPECT_EQ(progress_line("steps", 0, 5, 0), "0/5 steps [>                             ]");
}

TEST(Imbalance, IsSigned)
{
    FlakeCounts counts;
    counts.emitted = 10;
    counts.alive = 4;
    counts.left = 3;
    counts.landed = 2;
    counts.vanished = 1;
    EXPECT_EQ(imbalance(counts), 0);
    counts.alive = 5;
    EXPECT_EQ(imbalance(counts), -1);
    counts.alive = 2;
    EXPECT_EQ(imbalance(counts), 2);
}

}  // namespace

}  // namespace spindrift::app
