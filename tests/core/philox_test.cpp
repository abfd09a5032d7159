// SPDX-License-Identifier: MIT
#include "core/philox.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

namespace
{

using spindrift::Philox4;

struct KnownAnswer
{
    std::uint64_t key;
    Philox4<std::uint32_t> counter, words;
};

// Random123 1.14, tests/kat_vectors, "philox4x32 10"
const KnownAnswer kKnownAnswers[] = {
    {0, {0, 0, 0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
    {0xffffffffffffffffU,
     {0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
     {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
    {0x299f31d0a4093822U,
     {0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
     {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
};

TEST(Philox, GivesThePublishedKnownAnswers)
{
    for (const KnownAnswer& known : kKnownAnswers)
    {
        const auto words = spindrift::philox(known.key, known.counter);
        EXPECT_EQ(words.x0, known.words.x0);
        EXPECT_EQ(words.x1, known.words.x1);
        EXPECT_EQ(words.x2, known.words.x2);
        EXPECT_EQ(words.x3, known.words.x3);
    }
}

TEST(Philox, PutsEveryPartOfTheAddressIntoTheCounter)
{
    using spindrift::RandomStream;
    std::set<std::uint32_t> firsts;
    for (std::uint64_t seed : {1ULL, 2ULL, 1ULL << 32})
        for (std::uint32_t id : {0U, 1U})
            for (std::uint32_t step : {0U, 1U})
                for (RandomStream stream : {RandomStream::turbulence, RandomStream::emission})
                    for (std::uint32_t substep : {0U, 1U})
                        firsts.insert(spindrift::random_words(seed, id, step, stream, substep).x0);
    EXPECT_EQ(firsts.size(), 48U);
}

TEST(Mix32, GivesMurmur3FinalizerValues)
{
    // MurmurHash3_x86_32 of no bytes with this seed is fmix32(seed); SMHasher's published values
    EXPECT_EQ(spindrift::mix32(0U), 0U);
    EXPECT_EQ(spindrift::mix32(1U), 0x514E28B7U);
    EXPECT_EQ(spindrift::mix32(0xffffffffU), 0x81F16F39U);
}

TEST(Mix64, GivesSplitMix64Values)
{
    // first outputs of SplitMix64 (Vigna's splitmix64.c) seeded with 0
    EXPECT_EQ(spindrift::mix64(0x9E3779B97F4A7C15U), 0xE220A8397B1DCDAFU);
    EXPECT_EQ(spindrift::mix64(2 * 0x9E3779B97F4A7C15U), 0x6E789E6AA1B965F4U);
}

TEST(Mix32, TurnsHalfOfTheBitsWhenOneTurns)
{
    double turned = 0;
    const int samples = 2000;
    for (int i = 0; i < samples; ++i)
        for (int bit = 0; bit < 32; ++bit)
        {
            const auto h = static_cast<std::uint32_t>(i);
            turned += std::popcount(spindrift::mix32(h) ^ spindrift::mix32(h ^ (1U << bit)));
        }
    EXPECT_NEAR(turned / (samples * 32.0), 16.0, 0.05);
}

TEST(Uniform, StaysInsideTheOpenInterval)
{
    EXPECT_EQ(spindrift::uniform<float>(0U), 0x1p-24F);
    EXPECT_EQ(spindrift::uniform<float>(0xffffffffU), 1.0F - 0x1p-24F);
    EXPECT_EQ(spindrift::uniform<double>(0xffffffffU), 1.0 - 0x1p-24);
}

}  // namespace
