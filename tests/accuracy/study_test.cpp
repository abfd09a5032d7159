// SPDX-License-Identifier: MIT
#include "validation/study.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "cpu/cpu_backend.h"

namespace spindrift::validation
{

namespace
{

constexpr std::uint64_t kFlakes = 4000;
constexpr double kSeconds = 12;

/// Of the comparison, which is compiled for AVX2.
class Study : public testing::Test
{
  protected:
    void SetUp() override
    {
        const std::vector<cpu::Simd> available = cpu::available_simd();
        if (std::find(available.begin(), available.end(), cpu::Simd::scalar_fma) == available.end())
            GTEST_SKIP() << "this processor has no AVX2 with FMA";
    }

    static AdvectionPoint measured(const char* integrator, double dt, std::uint64_t flakes = kFlakes)
    {
        AdvectionSetting setting;
        setting.integrator = integrator, setting.dt_s = dt;
        return measure_advection(setting, flakes, kSeconds);
    }
};

TEST_F(Study, RivalsAreRightForShortSteps)
{
    for (const char* rival : {"bailey", "explicit-euler", "exact-ou-sum"})
    {
        const AdvectionPoint point = measured(rival, 0.005, 1000);
        EXPECT_FALSE(point.above_noise()) << rival << ": " << point.error;
        EXPECT_EQ(point.rogue_share, 0) << rival;
        EXPECT_GT(point.ns_per_flake_second, 0);
    }
}

TEST_F(Study, OursIsAtNoiseWhereTheImplicitStepIsNot)
{
    for (const double dt : {0.1, 0.4})
    {
        const AdvectionPoint ours = measured("ours", dt), bailey = measured("bailey", dt);
        EXPECT_FALSE(ours.above_noise()) << ours.error;
        EXPECT_EQ(ours.rogue_share, 0);
        EXPECT_TRUE(bailey.above_noise()) << bailey.error;
        EXPECT_GT(bailey.error, 3 * ours.error);
    }
}

TEST_F(Study, ExplicitEulerRunsAway)
{
    EXPECT_GT(measured("explicit-euler", 0.1).rogue_share, 0.05);
}

TEST_F(Study, PrecisionAndSamplingLeaveTheWalkInDoubleByAsMuchAsTheyShould)
{
    const auto off = [](const char* precision, const char* sampling, double dt = 0.02)
    {
        AdvectionSetting setting;
        setting.integrator = "ours", setting.dt_s = dt;
        setting.precision = precision, setting.sampling = sampling;
        return measure_advection(setting, 100, 1).path_error_m;
    };
    // float: 50 roundings of a metre; this holds our step in double to the backend's
    EXPECT_LT(off("float", "trilinear"), 3e-6);
    EXPECT_LT(off("float", "trilinear", 0.4), 3e-6) << "two relaxations a step, up to four sub-steps each";
    const double half = off("half", "trilinear");  // 11 bits of a velocity of 1 m/s
    EXPECT_GT(half, 1e-5);
    EXPECT_LT(half, 1e-3);
    const double nearest = off("float", "nearest");  // half a cell of 1 cm
    EXPECT_GT(nearest, 10 * half);
    EXPECT_LT(nearest, 0.05);
}

AdvectionPoint made_up(double ns, double error)
{
    AdvectionPoint point;
    point.ns_per_flake_second = ns, point.error = error, point.noise = 0.01;
    return point;
}

TEST(Frontier, KeepsWhatNobodyBeats)
{
    std::vector<AdvectionPoint> points = {made_up(100, 0.012), made_up(50, 0.010), made_up(10, 0.3),
                                          made_up(20, 0.5), made_up(5, 0.011)};
    points[4].setting.dt_s = 1;  // faster and as accurate as [1], but with ten times its step
    mark_frontier(points);
    EXPECT_FALSE(points[0].on_frontier);
    EXPECT_TRUE(points[1].on_frontier);
    EXPECT_FALSE(points[2].on_frontier);  // [4] is faster and more accurate beyond chance
    EXPECT_FALSE(points[3].on_frontier);
    EXPECT_TRUE(points[4].on_frontier);
}

TEST(TenTimes, ComparesOursWithTheImplicitStepAtATenth)
{
    const auto point = [](const char* integrator, double dt, double error)
    {
        AdvectionPoint p = made_up(1, error);
        p.setting.integrator = integrator, p.setting.dt_s = dt;
        return p;
    };
    EXPECT_EQ(equal_error_at_ten_times({point("ours", 0.1, 0.1), point("bailey", 0.01, 0.1),
                                        point("ours", 0.2, 0.3), point("bailey", 0.02, 0.2)}),
              0.1);
    EXPECT_EQ(equal_error_at_ten_times({point("ours", 0.2, 0.3), point("bailey", 0.02, 0.2)}), 0);
}

TEST(SolverStudy, ToleranceBelowTheGridsOwnErrorBuysNothing)
{
    const SolverPoint rough = measure_solver({16, 1e-1}, 2), usual = measure_solver({16, 1e-6}, 2),
                      fine = measure_solver({32, 1e-6}, 2);
    EXPECT_GT(rough.error, 1.05 * usual.error);
    EXPECT_NEAR(usual.error / fine.error, 4, 0.3);
    EXPECT_TRUE(usual.is_default);
}

}  // namespace

}  // namespace spindrift::validation
