// SPDX-License-Identifier: MIT
#include "cuda/sort/strategy.h"

#include <algorithm>
#include <numeric>

#include <gmock/gmock.h>

#include "cpu/sort/passes.h"
#include "cpu/sort/strategy.h"
#include "cuda/buffer.h"
#include "tests/cuda/device_fixture.h"
#include "tests/sort/patterns.h"

namespace spindrift::gpu
{

namespace
{

using Pairs = std::vector<std::uint64_t>;

constexpr std::size_t kMargin = 16;
constexpr std::uint64_t kGarbage = 0xdead'beef'0bad'cafeULL;

/// Slots ascend, with holes.
Pairs pairs_of(const std::vector<std::uint32_t>& keys)
{
    Pairs pairs(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) pairs[i] = std::uint64_t{keys[i]} << 32 | (2 * i + 1);
    return pairs;
}

/// The CPU's own answer.
Pairs in_order(const Pairs& pairs, int key_bits)
{
    Pairs from = pairs, scratch(pairs.size());
    const std::uint64_t* sorted =
        cpu::find_sort_strategy("radix")->sort({from.data(), scratch.data(), from.size(), key_bits});
    return {sorted, sorted + pairs.size()};
}

/// Device memory for pairs and scratch between margins that must survive.
class Arrays
{
  public:
    explicit Arrays(std::size_t capacity)
        : capacity_(capacity),
          pairs_(Pairs(capacity + 2 * kMargin, kGarbage)),
          scratch_(Pairs(capacity + 2 * kMargin, kGarbage))
    {
    }

    Pairs sort(DeviceSort& sort, const Pairs& input, int key_bits, int passes = 0,
               SortStart start = SortStart::exact)
    {
        const Stream stream;
        SortJob job{
            pairs_.data() + kMargin, scratch_.data() + kMargin, input.size(), key_bits, passes, start};
        copy_to_device_now(job.pairs, input.data(), input.size());
        const std::uint64_t* const result = sort.sort(stream, job);
        stream.ref().wait();
        EXPECT_TRUE(result == job.pairs || result == job.scratch);
        Pairs host(input.size());
        check(cudaMemcpy(host.data(), result, host.size() * sizeof(std::uint64_t), cudaMemcpyDeviceToHost),
              "cudaMemcpy");
        return host;
    }

    bool margins_untouched() const
    {
        for (const auto* array : {&pairs_, &scratch_})
        {
            Pairs host(array->size());
            check(cudaMemcpy(host.data(), array->data(), array->bytes(), cudaMemcpyDeviceToHost),
                  "cudaMemcpy");
            const auto is_garbage = [](std::uint64_t x) { return x == kGarbage; };
            if (!std::all_of(host.begin(), host.begin() + kMargin, is_garbage) ||
                !std::all_of(host.begin() + static_cast<std::ptrdiff_t>(kMargin + capacity_), host.end(),
                             is_garbage))
                return false;
        }
        return true;
    }

  private:
    std::size_t capacity_;
    DeviceBuffer<std::uint64_t> pairs_, scratch_;
};

/// The skip of DeviceTest for tests whose parameter is a row of the table.
class EveryDeviceSort : public DeviceTest, public testing::WithParamInterface<const SortStrategy*>
{
  protected:
    void expect_order(Arrays& arrays, DeviceSort& sort, const std::vector<std::uint32_t>& keys, int key_bits)
    {
        const Pairs input = pairs_of(keys);
        EXPECT_EQ(arrays.sort(sort, input, key_bits), in_order(input, key_bits));
    }
};

TEST_P(EveryDeviceSort, GivesTheOrderOfTheCpuAtAnySize)
{
    constexpr std::size_t kMost = 10007;
    const auto sort = GetParam()->make(2 * kMost);
    Arrays arrays(kMost);
    for (const std::size_t n : {0, 1, 2, 31, 32, 33, 255, 256, 257, 4095, 4096, 4097, 8192, 10007})
    {
        SCOPED_TRACE(n);
        const int bits = GetParam()->max_key_bits;
        expect_order(arrays, *sort, random_keys(n, bits), bits);
    }
    EXPECT_TRUE(arrays.margins_untouched());
}

TEST_P(EveryDeviceSort, GivesTheOrderOfTheCpuForAnyKeys)
{
    constexpr std::size_t n = 6007;
    const auto sort = GetParam()->make(2 * n);
    Arrays arrays(n);
    for (const int bits : {32, 24, 16})
    {
        if (bits > GetParam()->max_key_bits) continue;
        for (const Pattern& pattern : patterns())
        {
            SCOPED_TRACE(pattern.name + ", bits = " + std::to_string(bits));
            expect_order(arrays, *sort, pattern.keys(n, bits), bits);
        }
        // distances that were not numbers, infinite and negative, as the key maker would turn their bits
        std::vector<std::uint32_t> hostile = random_keys(n, bits);
        for (std::size_t i = 0; i < n; i += 3)
            hostile[i] =
                std::vector{~0x7FC00000U, ~0x7F800000U, 0U, ~0U, ~0xFFC00000U}[i % 5] & largest_key(bits);
        expect_order(arrays, *sort, hostile, bits);
    }
    EXPECT_TRUE(arrays.margins_untouched());
}

std::vector<const SortStrategy*> strategies_that_sort()
{
    std::vector<const SortStrategy*> result;
    for (const SortStrategy& strategy : sort_strategies())
        if (strategy.make != nullptr) result.push_back(&strategy);
    return result;
}

std::string test_name(const testing::TestParamInfo<const SortStrategy*>& row)
{
    std::string name(row.param->name);
    std::ranges::replace(name, '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Sorts, EveryDeviceSort, testing::ValuesIn(strategies_that_sort()), test_name);

/// Frames of a changing crowd: most flakes come nearer a little, some vanish, some appear.
class Crowd
{
  public:
    Crowd(std::size_t slots, std::size_t first_shown)
        : key_(random_keys(slots, 32)), first_shown_(first_shown)
    {
    }
    Pairs next()
    {
        ++frame_;
        Pairs pairs;
        for (std::size_t slot = 0; slot < key_.size(); ++slot)
        {
            key_[slot] += static_cast<std::uint32_t>((slot * 2654435761U + frame_) % 65536) << 12;
            if ((slot + first_shown_ * frame_) % 8 != 0)
                pairs.push_back(std::uint64_t{key_[slot]} << 32 | slot);
        }
        return pairs;
    }

  private:
    std::vector<std::uint32_t> key_;
    std::size_t first_shown_;
    std::size_t frame_ = 0;
};

class EveryPassSort : public EveryDeviceSort
{
};

TEST_P(EveryPassSort, KeepsTheSameOrderAsTheCpuFrameByFrame)
{
    constexpr std::size_t kSlots = 9001;
    const auto device = GetParam()->make(kSlots);
    cpu::PassSorter host(*GetParam()->network, kSlots);
    Arrays arrays(kSlots);
    Crowd crowd(kSlots, 3);
    for (int frame = 0; frame < 7; ++frame)
    {
        SCOPED_TRACE(frame);
        const Pairs input = crowd.next();
        const SortStart start = frame == 4 ? SortStart::exact : SortStart::as_kept;
        const int passes = 5 + 9 * frame;
        Pairs pairs = input, scratch(input.size());
        const std::uint64_t* const expected =
            host.sort({pairs.data(), scratch.data(), input.size(), 32}, passes, start);
        EXPECT_EQ(arrays.sort(*device, input, 32, passes, start), Pairs(expected, expected + input.size()));
    }
    EXPECT_TRUE(arrays.margins_untouched());
}

TEST_P(EveryPassSort, EndsExactAfterTheWholeNetwork)
{
    constexpr std::size_t n = 2100;
    const auto device = GetParam()->make(2 * n);
    Arrays arrays(n);
    const Pairs input = pairs_of(patterns().at(3).keys(n, 32));  // reversed
    const std::size_t all = network_steps(*GetParam()->network, n);
    EXPECT_NE(arrays.sort(*device, input, 32, static_cast<int>(all / 2), SortStart::as_kept),
              in_order(input, 32));
    EXPECT_EQ(arrays.sort(*device, input, 32, static_cast<int>(all - all / 2), SortStart::as_kept),
              in_order(input, 32));
}

std::vector<const SortStrategy*> strategies_over_frames()
{
    std::vector<const SortStrategy*> result;
    for (const SortStrategy& strategy : sort_strategies())
        if (strategy.network) result.push_back(&strategy);
    return result;
}

INSTANTIATE_TEST_SUITE_P(Sorts, EveryPassSort, testing::ValuesIn(strategies_over_frames()), test_name);

TEST(DeviceSorts, TableHoldsTheNamesOfTheCommandLine)
{
    std::vector<std::string_view> names;
    for (const SortStrategy& strategy : sort_strategies()) names.push_back(strategy.name);
    EXPECT_THAT(names, testing::ElementsAre("none", "cub-radix", "thrust", "cub-merge", "bitonic", "bucket16",
                                            "bitonic-passes", "odd-even-passes"));
    EXPECT_EQ(find_sort_strategy("auto")->name, "cub-radix");
    EXPECT_EQ(find_sort_strategy("passes")->name, "bitonic-passes");
    EXPECT_EQ(find_sort_strategy("radix"), nullptr) << "the CPU's is another sort";
}

}  // namespace

}  // namespace spindrift::gpu
