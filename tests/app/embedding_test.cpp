// SPDX-License-Identifier: MIT
#include "spindrift/simulation.h"

#include <gtest/gtest.h>

#include "tests/app/child_process.h"
#include "tests/app/command_fixture.h"

namespace spindrift::test
{

namespace
{

using Embedding = Command;

TEST_F(Embedding, GivesTheHashOfTheCommand)
{
    Simulation simulation(small_scene(), {.threads = 2, .simd = "scalar"});
    simulation.advance_to(20 * 0.05);
    EXPECT_EQ(simulation.steps(), 20U);
    const Finished run = run_command({"run", small_scene(), "--headless", "--steps", "20", "--hash"});
    char hash[32];
    std::snprintf(hash, sizeof hash, "hash %016llx",
                  static_cast<unsigned long long>(simulation.state_hash()));
    EXPECT_NE(run.output.find(hash), std::string::npos) << run.output << hash;
}

TEST_F(Embedding, FlakesAreInTheDomainAndCounted)
{
    Simulation simulation(small_scene());
    simulation.advance_to(1);
    const FlakeView flakes = simulation.flakes();
    std::uint64_t alive = 0;
    for (std::size_t i = 0; i < simulation.slots_used(); ++i)
    {
        if ((flakes.state[i] & 0xFFU) != static_cast<std::uint32_t>(Fate::alive)) continue;
        ++alive;
        ASSERT_TRUE(flakes.x[i] >= 0 && flakes.x[i] <= 40) << flakes.x[i];
        ASSERT_TRUE(flakes.z[i] >= 0 && flakes.z[i] <= 20) << flakes.z[i];
    }
    EXPECT_EQ(alive, simulation.counts().alive);
    EXPECT_GT(alive, 0U);
}

TEST_F(Embedding, SnapshotGoesBack)
{
    Simulation simulation(small_scene());
    simulation.advance_to(0.5);
    const std::uint64_t hash = simulation.state_hash();
    simulation.save(in_folder("s.snap"));
    simulation.advance_to(1);
    EXPECT_NE(simulation.state_hash(), hash);
    simulation.load(in_folder("s.snap"));
    EXPECT_EQ(simulation.state_hash(), hash);
    EXPECT_EQ(simulation.steps(), 10U);
}

TEST_F(Embedding, BadInputIsAnError)
{
    EXPECT_THROW(Simulation(in_folder("none.toml")), Error);
    EXPECT_THROW(Simulation(small_scene(), {.simd = "mmx"}), Error);
    EXPECT_THROW(Simulation(small_scene(), {.backend = "gpu"}), Error);
    Simulation simulation(small_scene());
    EXPECT_THROW(simulation.draw(), Error);
    EXPECT_THROW(simulation.write_picture(in_folder("x.png")), Error);
    EXPECT_THROW(simulation.advance_to(-1), Error);
}

}  // namespace

}  // namespace spindrift::test
