// SPDX-License-Identifier: MIT
// Row 9: the noise of one flake over many steps and of many in one is independent, and belongs to the flake.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/stress/tracers.h"

namespace spindrift::stress
{
namespace
{

/// Turbulence whose Cayley factor is 0: q after a step is that step's noise.
World fresh_noise(std::uint64_t flakes)
{
    World w = tracer_world(flakes, {50, 50, 50}, 0.1);
    w.wind = even_air({1, 0, 0, 1, 0, 1}, 40);  // C0 eps h / 4 = sigma^2
    return w;
}

using Sample = std::array<double, 3>;

Sample noise(const TestRun& run, std::size_t i)
{
    return {static_cast<double>(run.flakes.q1[i]), static_cast<double>(run.flakes.q2[i]),
            static_cast<double>(run.flakes.q3[i])};
}

/// All correlations of a sample with the one `lag` later, and within a sample, are chance: five standard
/// deviations. Mean and variance are those of a standard Gaussian.
void expect_independent(const std::vector<Sample>& samples, std::initializer_list<std::size_t> lags)
{
    const auto n = static_cast<double>(samples.size());
    for (const std::size_t lag : lags)
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b)
            {
                double sum = 0;
                for (std::size_t i = 0; i + lag < samples.size(); ++i)
                    sum += samples[i][a] * samples[i + lag][b];
                const bool self = lag == 0 && a == b;
                EXPECT_NEAR(sum / n, self ? 1.0 : 0.0, 5 * std::sqrt((self ? 2 : 1) / n))
                    << "components " << a << b << ", lag " << lag;
            }
}

TEST(Streams, OneFlakeOverManySteps)
{
    World w = fresh_noise(1);
    w.on_leave = OnLeave::wrap;
    w.wind.cells[0].s11 = w.wind.cells[0].s22 = w.wind.cells[0].s33 = 1e-3F;  // stays within
    w.wind.cells[0].c0_eps = 40e-6F;
    TestRun run(w);
    std::vector<Sample> samples;
    for (int i = 0; i < 20000; ++i)
    {
        run->step();
        samples.push_back(noise(run, 0));
    }
    ASSERT_EQ(run->counts().alive, 1U);
    expect_independent(samples, {0, 1, 2, 3, 16, 1024});
}

TEST(Streams, ManyFlakesInOneStep)
{
    TestRun run(fresh_noise(20000));
    run->step();
    std::vector<Sample> samples;
    for (const std::size_t i : living(run)) samples.push_back(noise(run, i));
    expect_independent(samples, {0, 1, 2, 8, 16, 256});
}

/// In any slot, on any thread, in any company.
TEST(Streams, BelongToTheFlakeNotToItsSlot)
{
    const World w = cpu::test::world_with_everything(3000, OnLeave::respawn, true);
    TestRun plain(w, {1, cpu::Simd::automatic, 0}), mixed(w, {2, cpu::Simd::automatic, 1});
    plain.steps(20), mixed.steps(20);
    EXPECT_EQ(plain->state_hash(), mixed->state_hash());
    World other = w;
    other.seed += 1;
    TestRun seeded(other);
    seeded.steps(20);
    EXPECT_NE(plain->state_hash(), seeded->state_hash());
}

}  // namespace
}  // namespace spindrift::stress
