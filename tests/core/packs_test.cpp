// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <string>
#include <vector>

#include "core/philox.h"
#include "number_operations.h"

namespace
{

using spindrift_test::Operation;
using spindrift_test::OperationData;

/// Patterns that cover the number line: random bits, random numbers of size 1, and every pairing of special
/// ones.
struct Arguments
{
    std::vector<std::uint32_t> a, b, c;
};

Arguments arguments()
{
    const std::uint32_t special[] = {
        0x00000000, 0x80000000, 0x00000001, 0x80000001, 0x007fffff, 0x00800000, 0x3f800000, 0xbf800000,
        0x3f000000, 0x3fc00000, 0x40200000, 0x4b000000, 0x4b000001, 0x4b800000, 0x4effffff, 0x4f000000,
        0xcf000000, 0xcf000001, 0x7f7fffff, 0xff7fffff, 0x7f800000, 0xff800000, 0x7fc00000, 0xffc00001,
        0x3eaaaaab, 0x3f2aaaab, 0x3f2aaaaa, 0xffffffff, 0x7fffffff, 0x42fe0000, 0xc3150000, 0x3e000000};
    Arguments args;
    for (std::uint32_t x : special)
        for (std::uint32_t y : special)
        {
            args.a.push_back(x);
            args.b.push_back(y);
            args.c.push_back(special[(x ^ y) % 32]);
        }
    for (std::uint32_t i = 0; i < 32768; ++i)
    {
        const auto words = spindrift::random_words(3, i, 0, spindrift::RandomStream::emission);
        const bool near_one = (i & 1) != 0;
        const auto shape = [near_one](std::uint32_t w)
        { return near_one ? (w & 0x81ffffffU) | 0x3e000000U : w; };
        args.a.push_back(shape(words.x0));
        args.b.push_back(shape(words.x1));
        args.c.push_back(shape(words.x2));
    }
    return args;
}

std::vector<std::uint32_t> run(const Operation& operation, const Arguments& args)
{
    std::vector<std::uint32_t> out(args.a.size());
    operation.run({args.a.data(), args.b.data(), args.c.data(), out.data(), static_cast<int>(out.size())});
    return out;
}

void expect_same_bits(const Operation* scalar, const Operation* pack)
{
    const Arguments args = arguments();
    for (; scalar->name != nullptr; ++scalar, ++pack)
    {
        ASSERT_STREQ(scalar->name, pack->name);
        const auto expected = run(*scalar, args);
        const auto got = run(*pack, args);
        for (std::size_t i = 0; i < got.size(); ++i)
            ASSERT_EQ(got[i], expected[i])
                << scalar->name << std::hex << " of " << args.a[i] << ", " << args.b[i] << ", " << args.c[i];
    }
    ASSERT_EQ(pack->name, nullptr);
}

TEST(Packs, Avx2GivesTheBitsOfScalarCode)
{
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
        GTEST_SKIP() << "this processor lacks AVX2 or FMA";
    expect_same_bits(spindrift_test::scalar_operations(), spindrift_test::avx2_operations());
}

TEST(Packs, Avx512GivesTheBitsOfScalarCode)
{
    if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512dq"))
        GTEST_SKIP() << "this processor lacks AVX-512 F or DQ";
    expect_same_bits(spindrift_test::scalar_operations(), spindrift_test::avx512_operations());
}

}  // namespace
