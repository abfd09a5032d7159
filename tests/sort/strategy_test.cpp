// SPDX-License-Identifier: MIT
#include "cpu/sort/strategy.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "patterns.h"

namespace spindrift::cpu
{
namespace
{

constexpr std::uint64_t kGarbage = 0xdead'beef'0bad'cafeULL;
constexpr std::size_t kMargin = 16;

std::vector<std::uint64_t> make_pairs(const std::vector<std::uint32_t>& keys)
{
    std::vector<std::uint64_t> pairs(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i)
        pairs[i] = std::uint64_t{keys[i]} << 32 | (3 * i + 1);  // slots ascend, with holes
    return pairs;
}

std::vector<std::uint64_t> oracle(std::vector<std::uint64_t> pairs)
{
    std::ranges::stable_sort(pairs, {}, [](std::uint64_t pair) { return pair >> 32; });
    return pairs;
}

// Pairs and scratch between margins of garbage that must survive.
struct Arrays
{
    explicit Arrays(const std::vector<std::uint64_t>& input)
        : n(input.size()), pairs(n + 2 * kMargin, kGarbage), scratch(n + 2 * kMargin, kGarbage)
    {
        std::ranges::copy(input, pairs.begin() + kMargin);
    }

    SortJob job(int key_bits) { return {pairs.data() + kMargin, scratch.data() + kMargin, n, key_bits}; }

    bool margins_untouched() const
    {
        const auto whole = [this](const std::vector<std::uint64_t>& array)
        {
            const auto is_garbage = [](std::uint64_t x) { return x == kGarbage; };
            return std::ranges::all_of(array.begin(), array.begin() + kMargin, is_garbage) &&
                   std::ranges::all_of(array.end() - kMargin, array.end(), is_garbage);
        };
        return whole(pairs) && whole(scratch);
    }

    std::size_t n;
    std::vector<std::uint64_t> pairs, scratch;
};

void expect_sorted(const SortStrategy& strategy, const std::vector<std::uint64_t>& input,
                   const std::vector<std::uint64_t>& expected, int key_bits)
{
    Arrays arrays(input);
    const SortJob job = arrays.job(key_bits);
    const std::uint64_t* result = strategy.sort(job);
    ASSERT_TRUE(result == job.pairs || result == job.scratch);
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), result));
    EXPECT_TRUE(arrays.margins_untouched());
}

class EveryStrategy : public testing::TestWithParam<const SortStrategy*>
{
  protected:
    const SortStrategy& strategy() const { return *GetParam(); }

    void expect_all(const std::vector<std::size_t>& sizes)
    {
        for (const int key_bits : {32, 24, 16})
        {
            if (key_bits > strategy().max_key_bits) continue;
            for (const Pattern& pattern : patterns())
                for (const std::size_t n : sizes)
                {
                    SCOPED_TRACE(pattern.name + ", n = " + std::to_string(n) +
                                 ", bits = " + std::to_string(key_bits));
                    const auto input = make_pairs(pattern.keys(n, key_bits));
                    expect_sorted(strategy(), input, oracle(input), key_bits);
                }
        }
    }
};

TEST_P(EveryStrategy, MatchesStableSortAtSmallSizes)
{
    expect_all({0, 1, 2, 31, 32, 33, 63, 64, 65, 255, 256, 257, 4095, 4096, 4097});
}

TEST_P(EveryStrategy, MatchesStableSortAtThousands)
{
    expect_all({65536, 100003});
}

TEST_P(EveryStrategy, MatchesStableSortPastAPowerOfTwo)
{
    const std::size_t n = (std::size_t{1} << 20) + (std::size_t{1} << 20) / 20;
    const int key_bits = std::min(32, strategy().max_key_bits);
    const auto input = make_pairs(random_keys(n, key_bits));
    expect_sorted(strategy(), input, oracle(input), key_bits);
}

TEST_P(EveryStrategy, GivesTheSameOrderForAnyThreadCount)
{
    tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
    const int key_bits = std::min(32, strategy().max_key_bits);
    // the second is long enough to give each of 7 threads a chunk
    for (const std::size_t n : {std::size_t{5000}, std::size_t{500003}})
    {
        const auto input = make_pairs(random_keys(n, key_bits));
        const auto expected = oracle(input);
        for (const int threads : {1, 2, 7})
        {
            SCOPED_TRACE(std::to_string(threads) + " threads, n = " + std::to_string(n));
            tbb::task_arena arena(threads);
            arena.execute([&] { expect_sorted(strategy(), input, expected, key_bits); });
        }
    }
}

TEST_P(EveryStrategy, SortsWhatItSortedBefore)
{
    const int key_bits = std::min(32, strategy().max_key_bits);
    const auto input = oracle(make_pairs(random_keys(20000, key_bits)));
    Arrays arrays(input);
    const std::uint64_t* result = strategy().sort(arrays.job(key_bits));
    EXPECT_TRUE(std::equal(input.begin(), input.end(), result));
}

std::vector<const SortStrategy*> strategies_that_sort()
{
    std::vector<const SortStrategy*> result;
    for (const SortStrategy& strategy : sort_strategies())
        if (strategy.sort) result.push_back(&strategy);
    return result;
}

INSTANTIATE_TEST_SUITE_P(Sorts, EveryStrategy, testing::ValuesIn(strategies_that_sort()),
                         [](const testing::TestParamInfo<const SortStrategy*>& row)
                         {
                             std::string name(row.param->name);
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

TEST(SortStrategies, TableHoldsTheNamesOfTheCommandLine)
{
    std::vector<std::string_view> names;
    for (const SortStrategy& strategy : sort_strategies()) names.push_back(strategy.name);
    EXPECT_THAT(names, testing::ElementsAre("none", "qsort", "std", "std-par", "radix", "counting16",
                                            "vqsort", "block-indirect", "bitonic-passes", "odd-even-passes"));
}

TEST(SortStrategies, FindsByNameAndOnlyByName)
{
    ASSERT_NE(find_sort_strategy("radix"), nullptr);
    EXPECT_EQ(find_sort_strategy("radix")->name, "radix");
    EXPECT_EQ(find_sort_strategy("none")->sort, nullptr);
    EXPECT_EQ(find_sort_strategy("auto")->name, "radix");
    EXPECT_EQ(find_sort_strategy("passes")->name, "bitonic-passes");
    EXPECT_EQ(find_sort_strategy("cub-radix"), nullptr);
    EXPECT_EQ(find_sort_strategy("Radix"), nullptr);
    EXPECT_EQ(find_sort_strategy(""), nullptr);
}

TEST(SortStrategies, EachRowCanBeShownAndUsed)
{
    for (const SortStrategy& strategy : sort_strategies())
    {
        EXPECT_FALSE(strategy.about.empty()) << strategy.name;
        EXPECT_THAT(strategy.max_key_bits, testing::AnyOf(16, 24, 32)) << strategy.name;
        EXPECT_GE(strategy.bytes_moved_per_pair_32, 0) << strategy.name;
    }
}

}  // namespace
}  // namespace spindrift::cpu
