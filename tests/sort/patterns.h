// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

/// A named way to fill n keys, each < 2^key_bits.
struct Pattern
{
    std::string name;
    std::vector<std::uint32_t> (*keys)(std::size_t n, int key_bits);
};

inline std::uint32_t largest_key(int key_bits)
{
    return static_cast<std::uint32_t>((std::uint64_t{1} << key_bits) - 1);
}

inline std::vector<std::uint32_t> random_keys(std::size_t n, int key_bits)
{
    std::mt19937 random(7);
    std::vector<std::uint32_t> keys(n);
    for (auto& key : keys) key = static_cast<std::uint32_t>(random()) & largest_key(key_bits);
    return keys;
}

inline const std::vector<Pattern>& patterns()
{
    static const std::vector<Pattern> all{
        {"random", random_keys},
        {"all_equal",
         [](std::size_t n, int bits) { return std::vector<std::uint32_t>(n, largest_key(bits) / 3); }},
        {"sorted",
         [](std::size_t n, int bits)
         {
             auto keys = random_keys(n, bits);
             std::ranges::sort(keys);
             return keys;
         }},
        {"reversed",
         [](std::size_t n, int bits)
         {
             auto keys = random_keys(n, bits);
             std::ranges::sort(keys, std::greater{});
             return keys;
         }},
        {"nearly_sorted",
         [](std::size_t n, int bits)
         {
             auto keys = random_keys(n, bits);
             std::ranges::sort(keys);
             std::mt19937 random(11);
             for (std::size_t i = 0; i < n / 50; ++i) std::swap(keys[random() % n], keys[random() % n]);
             return keys;
         }},
        {"few_distinct",  // the AND of five random words: entropy 0.201 per bit
         [](std::size_t n, int bits)
         {
             std::mt19937 random(13);
             std::vector<std::uint32_t> keys(n);
             for (auto& key : keys)
             {
                 key = largest_key(bits);
                 for (int i = 0; i < 5; ++i) key &= static_cast<std::uint32_t>(random());
             }
             return keys;
         }},
        {"constant_upper_digits",
         [](std::size_t n, int bits)
         {
             auto keys = random_keys(n, bits);
             for (auto& key : keys) key = (key & 0x3ffU) | (largest_key(bits) & 0xa5a5'a400U);
             return keys;
         }},
        {"constant_lower_digits",
         [](std::size_t n, int bits)
         {
             auto keys = random_keys(n, bits);
             for (auto& key : keys) key = (key & (largest_key(bits) << (bits - 6))) | 0x55U;
             return keys;
         }},
        {"middle_digit_constant",
         [](std::size_t n, int bits)
         {
             auto keys = random_keys(n, bits);
             for (auto& key : keys) key &= 0xff00'00ffU >> (32 - bits);
             return keys;
         }},
        {"two_extremes",
         [](std::size_t n, int bits)
         {
             auto keys = random_keys(n, bits);
             for (auto& key : keys) key = (key & 1U) != 0 ? largest_key(bits) : 0U;
             return keys;
         }},
        {"organ_pipe",  // rises, then falls: bad for quick sorts that take the middle as pivot
         [](std::size_t n, int bits)
         {
             std::vector<std::uint32_t> keys(n);
             for (std::size_t i = 0; i < n; ++i)
                 keys[i] = static_cast<std::uint32_t>(std::min(i, n - 1 - i)) & largest_key(bits);
             return keys;
         }},
    };
    return all;
}
