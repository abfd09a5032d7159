// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/emission_order.h"

namespace spindrift
{
namespace
{

/// Keys of `n` flakes in slots of random order, whose ids end at `next_id`, sorted by key alone.
struct Ties
{
    std::vector<std::uint32_t> ids;
    std::vector<std::uint64_t> pairs;

    Ties(std::size_t n, std::uint32_t keys, std::uint32_t next_id) : ids(n)
    {
        std::iota(ids.begin(), ids.end(), next_id - static_cast<std::uint32_t>(n));
        std::mt19937 random(7);
        std::shuffle(ids.begin(), ids.end(), random);
        for (std::size_t slot = 0; slot < n; ++slot)
            pairs.push_back(std::uint64_t{random() % keys} << 32 | slot);
        std::sort(pairs.begin(), pairs.end());
    }
};

TEST(EmissionOrder, PutsRunsOfEqualKeysInOrderOfEmissionThoughIdsWrap)
{
    for (const std::uint32_t next_id : {5000U, 300U, 0U})
        for (const std::uint32_t keys : {1U, 3U, 200U, 4000000000U})
        {
            Ties ties(1000, keys, next_id);
            const std::vector<std::uint64_t> before = ties.pairs;
            const EmissionOrder order{ties.pairs.data(), ties.pairs.size(), ties.ids.data(), next_id};
            for (std::size_t i = 0; i < ties.pairs.size(); ++i) order(i);
            const auto oldest_first = [&](std::uint64_t a, std::uint64_t b)
            {
                const auto age = [&](std::uint64_t pair)
                { return next_id - ties.ids[static_cast<std::uint32_t>(pair)]; };
                return a >> 32 != b >> 32 ? a >> 32 < b >> 32 : age(a) > age(b);
            };
            std::vector<std::uint64_t> expected = before;
            std::sort(expected.begin(), expected.end(), oldest_first);
            EXPECT_EQ(ties.pairs, expected) << keys << " keys, next id " << next_id;
        }
}

}  // namespace
}  // namespace spindrift
