// SPDX-License-Identifier: MIT
// The table of docs/physics.md "Numbers": each function of core/math.h against libm one precision up, over
// its whole domain.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/math.h"
#include "core/philox.h"

namespace
{

/// Distance between neighbouring numbers of T at `truth`.
template <class T, class Wide>
Wide ulp(Wide truth)
{
    const auto rounded = std::abs(static_cast<T>(truth));
    if (!std::isfinite(rounded))
        return std::numeric_limits<T>::max() - std::nextafter(std::numeric_limits<T>::max(), T{0});
    return static_cast<Wide>(std::nextafter(rounded, std::numeric_limits<T>::infinity())) -
           static_cast<Wide>(rounded);
}

template <class T, class Wide>
struct Row
{
    const char* name;
    const char* domain;
    T low, high;
    std::function<T(T)> function;
    std::function<Wide(Wide)> truth;
    double bound_ulp;
};

/// Largest error in ulp; prints the table's line.
template <class T, class Wide>
double measure(const Row<T, Wide>& row, const std::function<T(std::uint64_t)>& sample, std::uint64_t samples)
{
    double largest = 0;
    T at{};
    std::uint64_t used = 0;
    const auto check = [&](T x)
    {
        if (!(x >= row.low && x <= row.high)) return;
        ++used;
        const T got = row.function(x);
        const Wide truth = row.truth(static_cast<Wide>(x));
        double error = 0;
        if (std::isfinite(got))
            error = static_cast<double>(std::abs(static_cast<Wide>(got) - truth) / ulp<T>(truth));
        else if (got != static_cast<T>(truth) && !(std::isnan(got) && std::isnan(truth)))
            error = std::numeric_limits<double>::infinity();
        if (error > largest) largest = error, at = x;
    };
    for (std::uint64_t i = 0; i < samples; ++i) check(sample(i));
    for (T centre : {T{0}, T{0.125}, T{0.25}, T{0.5}, T{0.75}, T{1}, T{2}, T(2.0 / 3), T(4.0 / 3)})
        for (int sign : {-1, 1})
        {
            T up = static_cast<T>(sign) * centre, down = up;
            for (int i = 0; i < 2000; ++i)
            {
                check(up), check(down);
                up = std::nextafter(up, std::numeric_limits<T>::infinity());
                down = std::nextafter(down, -std::numeric_limits<T>::infinity());
            }
        }
    std::printf("| %-6s | %-6s | %-18s | %8llu | %.3f | %.9g |\n", row.name,
                sizeof(T) == 4 ? "float" : "double", row.domain, static_cast<unsigned long long>(used),
                largest, static_cast<double>(at));
    return largest;
}

template <class Wide>
Wide turned(Wide u, bool cosine)
{
    // exact reduction to |r| <= 1/8 in the wider type
    const Wide turn = u - std::nearbyint(u);
    const Wide quarters = std::nearbyint(4 * turn);
    const Wide angle = (turn - quarters / 4) * 2 * std::numbers::pi_v<Wide>;
    const int q = (static_cast<int>(quarters) + (cosine ? 1 : 0)) & 3;
    const Wide size = (q & 1) != 0 ? std::cos(angle) : std::sin(angle);
    return (q & 2) != 0 ? -size : size;
}

template <class T>
T sine(T u)
{
    T s, c;
    spindrift::sincos_turns(u, s, c);
    return s;
}
template <class T>
T cosine(T u)
{
    T s, c;
    spindrift::sincos_turns(u, s, c);
    return c;
}

template <class T, class Wide>
std::vector<Row<T, Wide>> rows()
{
    const T all = std::numeric_limits<T>::max();
    const T tiny = std::numeric_limits<T>::denorm_min();
    const bool coarse = sizeof(T) == 4;
    const T exponent = coarse ? T(130) : T(1030);
    return {
        {"log2", "all > 0", tiny, all, [](T x) { return spindrift::log2(x); },
         [](Wide x) { return std::log2(x); }, 2.0},
        {"log", "all > 0", tiny, all, [](T x) { return spindrift::log(x); },
         [](Wide x) { return std::log(x); }, 1.5},
        {"exp2", coarse ? "[-155, 130]" : "[-1080, 1030]", -exponent * T(1.2), exponent,
         [](T x) { return spindrift::exp2(x); }, [](Wide x) { return std::exp2(x); }, 1.5},
        {"exp2_inside", "[-126, 126]", T(-126), T(126), [](T x) { return spindrift::exp2_inside(x); },
         [](Wide x) { return std::exp2(x); }, 1.5},
        {"exp", coarse ? "[-155, 130]" : "[-1080, 1030]", -exponent * T(1.2), exponent,
         [](T x) { return spindrift::exp(x); }, [](Wide x) { return std::exp(x); }, 1.5},
        {"sin", "all turns", -all, all, [](T x) { return sine(x); }, [](Wide x) { return turned(x, false); },
         1.5},
        {"cos", "all turns", -all, all, [](T x) { return cosine(x); }, [](Wide x) { return turned(x, true); },
         1.5},
        {"atan", "all", -all, all, [](T x) { return spindrift::atan(x); },
         [](Wide x) { return std::atan(x); }, coarse ? 2.0 : 2.2},
        {"sqrt", "all >= 0", T{0}, all, [](T x) { return spindrift::sqrt(x); },
         [](Wide x) { return std::sqrt(x); }, 0.5001},
    };
}

template <class T, class Wide>
void check_table(const std::function<T(std::uint64_t)>& any_number)
{
    std::printf("| function | type | domain | samples | largest error, ulp | at |\n");
    for (const auto& row : rows<T, Wide>())
    {
        const bool bounded = row.high < std::numeric_limits<T>::max();
        const auto in_domain = [&](std::uint64_t i) -> T
        {
            if (bounded && (i & 1) != 0)  // half of the samples uniform in the domain
                return row.low + (row.high - row.low) *
                                     static_cast<T>(static_cast<double>(spindrift::mix64(i) >> 11) * 0x1p-53);
            return any_number(i);
        };
        EXPECT_LE((measure<T, Wide>(row, in_domain, 400000)), row.bound_ulp) << row.name;
    }
}

TEST(MathTable, FloatStaysWithinItsBounds)
{
    // a stride prime to 2^32 walks the whole number line: denormals, huge, negative
    check_table<float, double>([](std::uint64_t i)
                               { return std::bit_cast<float>(static_cast<std::uint32_t>(i * 10737U)); });
}

TEST(MathTable, DoubleStaysWithinItsBounds)
{
    check_table<double, long double>([](std::uint64_t i)
                                     { return std::bit_cast<double>(spindrift::mix64(i)); });
}

TEST(MathTable, PowerFollowsItsStatedError)
{
    double largest = 0;
    for (std::uint32_t i = 0; i < 200000; ++i)
    {
        const auto words = spindrift::random_words(1, i, 0, spindrift::RandomStream::emission);
        const float x = spindrift::exp2(40 * spindrift::uniform<float>(words.x0) - 20);
        const float y = 4 * spindrift::uniform<float>(words.x1) - 2;
        const double truth = std::pow(double{x}, double{y});
        const double allowed = 1.2e-7 * std::abs(y * std::log2(double{x})) + 3e-7;
        largest = std::max(largest, std::abs(spindrift::pow(x, y) / truth - 1) / allowed);
    }
    EXPECT_LE(largest, 1.0);
    EXPECT_EQ(spindrift::pow(0.0F, 0.33F), 0.0F);
}

}  // namespace
