// SPDX-License-Identifier: MIT
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/child_process.h"
#include "tests/app/command_fixture.h"

namespace spindrift::test
{

namespace
{

using nlohmann::json;

class Statistics : public Command
{
  protected:
    json stats_of(std::vector<std::string> arguments)
    {
        const std::string file = in_folder("stats.json");
        arguments.insert(arguments.end(), {"--stats", file, "--hash"});
        const Finished run = run_command(arguments);
        EXPECT_EQ(run.exit_code, 0) << run.error;
        json stats = json::parse(read(file));
        EXPECT_THAT(run.output, testing::HasSubstr("hash " + stats.at("state_hash").get<std::string>()));
        return stats;
    }
};

bool mentions(const json& skips, const std::string& what)
{
    return std::any_of(skips.begin(), skips.end(),
                       [&](const json& skip) {
                           return skip.at("what").get<std::string>().find(what) != std::string::npos &&
                                  skip.at("why") != "";
                       });
}

TEST_F(Statistics, OfASimulationBalance)
{
    const json stats =
        stats_of({"run", small_scene(), "--headless", "--steps", "60", "--threads", "2", "--simd", "scalar"});
    const json& counts = stats.at("counts");
    EXPECT_EQ(counts.at("emitted").get<std::uint64_t>(),
              counts.at("alive").get<std::uint64_t>() + counts.at("left").get<std::uint64_t>() +
                  counts.at("landed").get<std::uint64_t>() + counts.at("vanished").get<std::uint64_t>());
    EXPECT_TRUE(counts.at("balance").at("holds"));
    EXPECT_GT(counts.at("emitted"), 15000);
    EXPECT_EQ(counts.at("rogue"), 0);
    EXPECT_LT(stats.at("bounds").at("min_m")[0], stats.at("bounds").at("max_m")[0]);
    EXPECT_EQ(stats.at("steps"), 60);
    EXPECT_EQ(stats.at("backend").at("name"), "cpu");
    EXPECT_EQ(stats.at("backend").at("threads"), 2);
    EXPECT_EQ(stats.at("backend").at("simd"), "scalar");
    EXPECT_NE(stats.at("backend").at("why"), "");
    EXPECT_EQ(stats.at("stages_ms").at("advect").at("samples"), 60);
    EXPECT_LE(stats.at("stages_ms").at("advect").at("median"), stats.at("stages_ms").at("advect").at("p95"));
    EXPECT_LE(stats.at("memory").at("bytes_per_particle").at("all_buffers"), 64);
    EXPECT_GT(stats.at("memory").at("peak_resident_bytes"), 1000000);
    EXPECT_TRUE(stats.at("gl").contains("skipped"));
    EXPECT_FALSE(stats.at("interrupted"));
}

TEST_F(Statistics, SayWhatTheSimulationLeftOut)
{
    std::string calm = read(small_scene());
    calm.replace(calm.find("source = \"log\""), 14, "source = \"calm\"");
    for (const char* key : {"speed_m_s", "reference_height_m", "roughness_m", "from_direction_deg"})
    {
        const std::size_t at = calm.find(key);
        calm.erase(at, calm.find('\n', at) + 1 - at);
    }
    const json still = stats_of({"run", write("calm.toml", calm), "--headless", "--steps", "2"});
    EXPECT_TRUE(mentions(still.at("skipped"), "turbulence"));
    EXPECT_TRUE(mentions(still.at("skipped"), "re-ordering by cell"));
    const json gusty = stats_of({"run", small_scene(), "--headless", "--steps", "2"});
    EXPECT_FALSE(mentions(gusty.at("skipped"), "turbulence"));
}

}  // namespace

}  // namespace spindrift::test
