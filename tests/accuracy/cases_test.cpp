// SPDX-License-Identifier: MIT
// Every case of `spindrift validate` with few flakes; what it allows follows from their number.
#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

#include "validation/check.h"

namespace spindrift::validation
{

namespace
{

struct Small
{
    const char* name;
    std::uint64_t particles;
    std::vector<double> dt_s;
};

void PrintTo(const Small& small, std::ostream* out)
{
    *out << small.name;
}

const Case& find_case(const std::string& name)
{
    return *std::find_if(cases().begin(), cases().end(), [&](const Case& c) { return c.name == name; });
}

class EveryCase : public testing::TestWithParam<Small>
{
};

TEST_P(EveryCase, AgreesWithItsTruth)
{
    const Small& small = GetParam();
    Settings settings;
    settings.particles = small.particles;
    settings.dt_s = small.dt_s;
    const char* data = std::getenv("SPINDRIFT_TEST_DATA");
    settings.data_folder = data != nullptr ? data : "";
    settings.scene_folder = std::string(SPINDRIFT_SOURCE_DIR) + "/scenes";
    const Outcome outcome = find_case(small.name).run(settings);
    if (!outcome.skipped.empty()) GTEST_SKIP() << outcome.skipped;
    EXPECT_FALSE(outcome.checks.empty());
    for (const Check& check : outcome.checks)
        EXPECT_TRUE(check.pass()) << check.metric << ": " << check.measured << ", truth " << check.truth
                                  << ", noise " << check.noise << ", allowed " << check.allowed;
}

const Small kSmall[] = {
    {"ornstein-uhlenbeck", 200, {}},
    {"taylor", 2000, {0.02}},
    {"gaussian-plume", 3000, {0.05}},
    {"power-law-plume", 2000, {0.05}},
    {"sinusoid", 5000, {0.02, 0.1, 0.4}},
    {"channel", 4000, {0.05}},
    {"surface-layer", 4000, {0.1}},
    {"rouse", 300, {0.02}},
    {"settling", 100, {0.001, 0.02, 0.5}},
    {"uniform-wind", 20000, {0.1}},
    {"solver-order", 0, {}},
    {"prairie-grass", 400, {0.1}},
};

std::string test_name(const testing::TestParamInfo<Small>& info)
{
    std::string name = info.param.name;
    name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
    return name;
}

INSTANTIATE_TEST_SUITE_P(Validation, EveryCase, testing::ValuesIn(kSmall), test_name);

TEST(Cases, AreAllTestedHere)
{
    EXPECT_EQ(cases().size(), std::size(kSmall));
    for (const Small& small : kSmall)
        EXPECT_TRUE(
            std::any_of(cases().begin(), cases().end(), [&](const Case& c) { return c.name == small.name; }))
            << small.name;
}

TEST(Check, FailsBeyondWhatIsAllowedAndForWhatIsNoNumber)
{
    EXPECT_TRUE(sampled("m", 1.029, 1, 0.01, 3).pass());
    EXPECT_FALSE(sampled("m", 1.031, 1, 0.01, 3).pass());
    EXPECT_FALSE(sampled("m", 0.969, 1, 0.01, 3).pass());
    EXPECT_TRUE(at_most("m", -5, 1).pass());
    EXPECT_FALSE(at_most("m", 1.1, 1).pass());
    EXPECT_FALSE((Check{"m", std::nan(""), 0, 0, 1e9}).pass());
}

}  // namespace

}  // namespace spindrift::validation
