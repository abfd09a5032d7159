// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"
#include "cpu/sort/inversions.h"
#include "worlds.h"

namespace spindrift::cpu::test
{
namespace
{

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

double distance2(const TestRun& run, const View& v, std::uint32_t slot)
{
    const auto d = [](float a, float b)
    {
        return (static_cast<double>(a) - static_cast<double>(b)) *
               (static_cast<double>(a) - static_cast<double>(b));
    };
    return d(run.flakes.x[slot], v.eye.x) + d(run.flakes.y[slot], v.eye.y) + d(run.flakes.z[slot], v.eye.z);
}

/// By how much a flake is inside the widened frustum, in metres; negative: outside.
double inside_by(const TestRun& run, const View& v, std::size_t i)
{
    const double d[3] = {run.flakes.x[i] - static_cast<double>(v.eye.x),
                         run.flakes.y[i] - static_cast<double>(v.eye.y),
                         run.flakes.z[i] - static_cast<double>(v.eye.z)};
    const auto along = [&](const Vec3f& a)
    {
        return d[0] * static_cast<double>(a.x) + d[1] * static_cast<double>(a.y) +
               d[2] * static_cast<double>(a.z);
    };
    const double focal = v.height_px / (2.0 * static_cast<double>(v.tan_half_fov_y));
    const double depth = along(v.forward);
    const double guard = static_cast<double>(v.guard_px);
    return std::min({depth - static_cast<double>(v.near_m), static_cast<double>(v.far_m) - depth,
                     depth * (0.5 * v.width_px + guard) / focal - std::abs(along(v.right)),
                     depth * (0.5 * v.height_px + guard) / focal - std::abs(along(v.up))});
}

class DrawListOf : public testing::TestWithParam<Simd>
{
  protected:
    DrawListOf() : run(world_with_everything(20000, OnLeave::wrap, true), {2, GetParam()}) { run.steps(40); }
    std::vector<std::uint64_t> pairs(const DrawList& list) const
    {
        const std::uint64_t* from =
            list.in_scratch ? run.memory.draw_list().scratch : run.memory.draw_list().pairs;
        return {from, from + list.count};
    }
    TestRun run;
};

TEST_P(DrawListOf, HoldsExactlyTheFlakesInView)
{
    const View v = camera();
    const DrawList list = run->prepare(v, {"none", 32});
    EXPECT_FALSE(list.sorted);
    EXPECT_EQ(list.count + list.culled, run->counts().alive);
    std::vector<bool> listed(run->slots_used());
    for (const std::uint64_t pair : pairs(list)) listed[pair & 0xFFFFFFFFU] = true;
    std::uint64_t inside = 0;
    for (std::size_t i = 0; i < run->slots_used(); ++i)
    {
        const bool alive = (run.flakes.state[i] & 0xFFU) == 0;
        const double by = inside_by(run, v, i);
        if (std::abs(by) < 1e-4) continue;  // rounding may decide
        ASSERT_EQ(listed[i], alive && by > 0) << "slot " << i << ", inside by " << by;
        inside += listed[i] ? 1 : 0;
    }
    EXPECT_GT(inside, 500U);
    EXPECT_LT(inside, run->counts().alive);
}

TEST_P(DrawListOf, GoesFromFarToNear)
{
    const View v = camera();
    for (const int bits : {32, 24, 16})
    {
        const std::vector<std::uint64_t> list = pairs(run->prepare(v, {"radix", bits}));
        ASSERT_TRUE(std::is_sorted(list.begin(), list.end()));  // equal keys: by slot, which is by id
        const double bucket_m = bits == 32 ? 1e-5 : 90.0 / (1 << bits);
        for (std::size_t i = 1; i < list.size(); ++i)
            ASSERT_GE(std::sqrt(distance2(run, v, static_cast<std::uint32_t>(list[i - 1]))) + bucket_m,
                      std::sqrt(distance2(run, v, static_cast<std::uint32_t>(list[i]))));
        for (const std::uint64_t pair : list) ASSERT_EQ(bits < 32 ? pair >> 32 >> bits : 0, 0U);
    }
}

TEST_P(DrawListOf, OfPassesBeginsExactGoesOnAndBeginsAnewWhenFlakesOrViewChange)
{
    View v = camera();
    const auto inversions = [&](const SortSettings& settings)
    {
        const std::vector<std::uint64_t> list = pairs(run->prepare(v, settings));
        EXPECT_GT(list.size(), 500U);
        return inversion_fraction(list);
    };
    const SortSettings two{"passes", 32, 2};
    EXPECT_EQ(inversions(two), 0) << "nothing to go on from";
    run.steps(1);
    const double after_a_step = inversions(two);
    EXPECT_GT(after_a_step, 0);
    EXPECT_LT(after_a_step, 0.2);
    const Snapshot snapshot = run->save();
    run->restore(snapshot);
    EXPECT_EQ(inversions(two), 0) << "nobody knows which flakes were restored";
    run.steps(1);
    v.eye = v.eye - Vec3f{6, 0, 0};
    EXPECT_EQ(inversions(two), 0) << "the view jumped";
    run.steps(1);
    inversions({"radix", 32});
    EXPECT_EQ(inversions(two), 0) << "another sort ran";
    EXPECT_THROW(inversions({"passes", 32, 0}), Error);
}

TEST_P(DrawListOf, IsTheSameForEveryInstructionSet)
{
    TestRun scalar(world_with_everything(20000, OnLeave::wrap, true), {1, Simd::scalar});
    scalar.steps(40);
    const DrawList a = run->prepare(camera(), {"none", 24});
    const DrawList b = scalar->prepare(camera(), {"none", 24});
    ASSERT_EQ(a.count, b.count);
    EXPECT_TRUE(std::equal(run.memory.draw_list().pairs, run.memory.draw_list().pairs + a.count,
                           scalar.memory.draw_list().pairs));
}

TEST_P(DrawListOf, RefusesAnUnknownSortNamingTheKnown)
{
    try
    {
        run->prepare(camera(), {"bogo", 32});
        FAIL();
    }
    catch (const Error& e)
    {
        EXPECT_NE(std::string(e.what()).find("radix"), std::string::npos) << e.what();
    }
    EXPECT_THROW(run->prepare(camera(), {"radix", 17}), Error);
}

std::string test_name(const testing::TestParamInfo<Simd>& of)
{
    return of.param == Simd::scalar_fma ? "scalar_fma" : simd_name(of.param);
}

INSTANTIATE_TEST_SUITE_P(EverySimd, DrawListOf, testing::ValuesIn(available_simd()), test_name);

}  // namespace
}  // namespace spindrift::cpu::test
