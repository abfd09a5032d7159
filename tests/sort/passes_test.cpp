// SPDX-License-Identifier: MIT
#include "cpu/sort/passes.h"

#include <algorithm>
#include <bit>
#include <set>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "cpu/sort/inversions.h"
#include "patterns.h"

namespace spindrift::cpu
{
namespace
{

using Pairs = std::vector<std::uint64_t>;

Pairs pairs_of(const std::vector<std::uint32_t>& keys)
{
    Pairs pairs(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) pairs[i] = std::uint64_t{keys[i]} << 32 | i;
    return pairs;
}

Pairs sorted(Pairs pairs)
{
    std::ranges::sort(pairs);
    return pairs;
}

Pairs run(PassSorter& sorter, const Pairs& input, int passes, SortStart start)
{
    Pairs pairs = input, scratch(input.size());
    const std::uint64_t* const result =
        sorter.sort({pairs.data(), scratch.data(), pairs.size(), 32}, passes, start);
    return {result, result + input.size()};
}

TEST(SortNetwork, ComparatorsOfAStepTouchEachElementOnceAndStayInside)
{
    for (const Network network : {Network::bitonic, Network::odd_even})
        for (const std::size_t n : {2, 3, 31, 32, 33, 1000, 4097})
        {
            NetworkWalk walk(network);
            for (std::size_t s = 0; s < std::min<std::size_t>(network_steps(network, n), 100); ++s)
            {
                const NetworkStep step = walk.next(n);
                std::set<std::size_t> touched;
                for (std::size_t c = 0; c < step.comparators(n); ++c)
                {
                    const std::size_t upper = step.upper(c), lower = step.lower(upper);
                    ASSERT_LT(upper, n);
                    ASSERT_LT(lower, upper);
                    ASSERT_TRUE(touched.insert(upper).second && touched.insert(lower).second);
                }
            }
        }
}

// A network that sorts all sequences of zeros and ones sorts everything (Knuth, TAOCP 3, 5.3.4).
TEST(SortNetwork, SortsEverySequenceOfZerosAndOnes)
{
    for (const Network network : {Network::bitonic, Network::odd_even})
        for (std::size_t n = 2; n <= 13; ++n)
            for (std::uint32_t bits = 0; bits < 1U << n; ++bits)
            {
                std::uint32_t row = bits;
                NetworkWalk walk(network);
                for (std::size_t s = 0; s < network_steps(network, n); ++s)
                {
                    const NetworkStep step = walk.next(n);
                    for (std::size_t c = 0; c < step.comparators(n); ++c)
                    {
                        const std::size_t upper = step.upper(c), lower = step.lower(upper);
                        if ((row >> lower & 1U) > (row >> upper & 1U)) row ^= 1U << lower | 1U << upper;
                    }
                }
                const int ones = std::popcount(bits);
                ASSERT_EQ(row, ((1U << ones) - 1U) << (n - static_cast<std::size_t>(ones)))
                    << n << " " << bits;
            }
}

TEST(SortNetwork, KnowsItsStepsAndSweeps)
{
    EXPECT_EQ(network_steps(Network::bitonic, 1), 0U);
    EXPECT_EQ(network_steps(Network::bitonic, 15'000), 105U);
    EXPECT_EQ(network_steps(Network::bitonic, 1'000'000), 210U);
    EXPECT_EQ(network_steps(Network::odd_even, 777), 777U);
    EXPECT_EQ(bitonic_sweeps(4096), 1U);
    EXPECT_EQ(bitonic_sweeps(std::size_t{1} << 20), 45U);
    EXPECT_EQ(bitonic_sweeps(std::size_t{1} << 22), 66U);
    EXPECT_EQ(bitonic_sweeps(std::size_t{1} << 24), 91U);
}

class EveryNetwork : public testing::TestWithParam<Network>
{
};

TEST_P(EveryNetwork, EndsExactAfterItsSteps)
{
    for (const std::size_t n : {0, 1, 2, 33, 4095, 4096, 4097, 9001})
        for (const Pattern& pattern : patterns())
        {
            SCOPED_TRACE(pattern.name + ", n = " + std::to_string(n));
            PassSorter sorter(GetParam(), n);
            const Pairs input = pairs_of(pattern.keys(n, 32));
            const auto steps = static_cast<int>(network_steps(GetParam(), n));
            EXPECT_EQ(run(sorter, input, std::max(steps, 1), SortStart::as_kept), sorted(input));
        }
}

TEST_P(EveryNetwork, NeverAddsAnInversionWhileKeysStandStill)
{
    constexpr std::size_t n = 3000;
    PassSorter sorter(GetParam(), n);
    const Pairs input = pairs_of(random_keys(n, 32));
    double before = inversion_fraction(input);
    EXPECT_NEAR(before, 0.5, 0.02);
    for (int frame = 0; frame < 60; ++frame)
    {
        const double now = inversion_fraction(run(sorter, input, 2, SortStart::as_kept));
        ASSERT_LE(now, before);
        before = now;
    }
    EXPECT_LT(before, 0.5);
}

TEST_P(EveryNetwork, KeepsTheOrderOfThoseThatStayAndPutsNewOnesBehind)
{
    constexpr std::size_t kSlots = 40'000;  // several chunks
    PassSorter sorter(GetParam(), kSlots);
    const auto keys = random_keys(kSlots, 32);
    Pairs first, second, expected;
    for (std::uint64_t slot = 0; slot < kSlots; ++slot)
    {
        if (slot % 3 != 0) first.push_back(std::uint64_t{keys[slot]} << 32 | slot);
        if (slot % 4 != 0) second.push_back(std::uint64_t{keys[slot]} << 32 | slot);
    }
    for (const std::uint64_t pair : run(sorter, first, 1, SortStart::exact))
        if (static_cast<std::uint32_t>(pair) % 4 != 0) expected.push_back(pair);
    for (const std::uint64_t pair : second)
        if (static_cast<std::uint32_t>(pair) % 3 == 0) expected.push_back(pair);
    NetworkWalk walk(GetParam());
    const NetworkStep step = walk.next(expected.size());
    for (std::size_t c = 0; c < step.comparators(expected.size()); ++c)
    {
        auto& upper = expected[step.upper(c)];
        auto& lower = expected[step.lower(step.upper(c))];
        if (upper < lower) std::swap(upper, lower);
    }
    EXPECT_EQ(run(sorter, second, 1, SortStart::as_kept), expected);
}

TEST_P(EveryNetwork, StartsAnewWhenItIsTold)
{
    constexpr std::size_t n = 5000;
    PassSorter sorter(GetParam(), n);
    const Pairs input = pairs_of(random_keys(n, 32));
    EXPECT_NE(run(sorter, input, 1, SortStart::as_kept), sorted(input));
    EXPECT_EQ(run(sorter, input, 1, SortStart::exact), sorted(input));
    EXPECT_EQ(run(sorter, input, 1, SortStart::as_kept), sorted(input)) << "what is sorted stays sorted";
}

TEST_P(EveryNetwork, GivesTheSameOrderForAnyThreadCount)
{
    tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
    constexpr std::size_t n = 150'001;
    Pairs expected;
    for (const int threads : {1, 2, 7})
    {
        tbb::task_arena arena(threads);
        PassSorter sorter(GetParam(), n);
        Pairs result;
        arena.execute(
            [&]
            {
                for (const std::uint32_t frame : {1U, 2U, 3U})
                {
                    auto keys = random_keys(n, 32);
                    for (std::size_t i = 0; i < n; i += frame) keys[i] += frame << 20;
                    result = run(sorter, pairs_of(keys), 7, SortStart::as_kept);
                }
            });
        if (expected.empty()) expected = result;
        EXPECT_EQ(result, expected) << threads << " threads";
    }
}

INSTANTIATE_TEST_SUITE_P(Networks, EveryNetwork, testing::Values(Network::bitonic, Network::odd_even),
                         [](const testing::TestParamInfo<Network>& of)
                         { return of.param == Network::bitonic ? "bitonic" : "odd_even"; });

TEST(InversionFraction, CountsCouplesInTheWrongOrder)
{
    EXPECT_EQ(inversion_fraction(Pairs{}), 0);
    EXPECT_EQ(inversion_fraction(Pairs{7}), 0);
    EXPECT_EQ(inversion_fraction(Pairs{1, 2, 3, 4}), 0);
    EXPECT_EQ(inversion_fraction(Pairs{4, 3, 2, 1}), 1);
    EXPECT_DOUBLE_EQ(inversion_fraction(Pairs{2, 3, 5, 1, 4}), 4 / 10.0);
    const Pairs pairs = pairs_of(random_keys(700, 32));
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        for (std::size_t j = i + 1; j < pairs.size(); ++j) wrong += pairs[i] > pairs[j] ? 1 : 0;
    EXPECT_DOUBLE_EQ(inversion_fraction(pairs), static_cast<double>(wrong) / (700.0 * 699.0 / 2));
}

TEST(InversionFraction, ComparesOrdersWhoseKeysDiffer)
{
    const Pairs exact{50ULL << 32 | 2, 60ULL << 32 | 0, 70ULL << 32 | 1};
    const Pairs coarse{5ULL << 32 | 0, 5ULL << 32 | 2, 7ULL << 32 | 1};
    EXPECT_DOUBLE_EQ(inversion_fraction(coarse, exact, 3), 1 / 3.0);
    EXPECT_EQ(inversion_fraction(exact, exact, 3), 0);
}

}  // namespace
}  // namespace spindrift::cpu
