// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/child_process.h"
#include "tests/app/command_fixture.h"
#include "tests/app/solved_house.h"

namespace spindrift::test
{

namespace
{

using ::testing::HasSubstr;

TEST_F(Command, WindIsSolvedWrittenKeptAndReadBack)
{
    const std::string scene = write("house.toml", kHouse), out = in_folder("wind.nc"),
                      again = in_folder("again.nc");
    const Finished first = run_command({"wind", scene, "-o", out});
    EXPECT_EQ(first.exit_code, 0) << first.error;
    for (const char* word :
         {"30 x 20 x 12 cells", "1 block(s)", "multigrid", "relative residual", "kept in", "wrote"})
        EXPECT_THAT(first.output, HasSubstr(word));
    EXPECT_EQ(first.error, "") << "no bar without a terminal";
    const Finished second = run_command({"wind", scene, "-o", again, "--threads", "1"});
    EXPECT_THAT(second.output, HasSubstr("taken from"));
    EXPECT_EQ(read(out), read(again));

    const auto hash = [&]
    {
        const Finished run = run_command({"run", scene, "--headless", "--steps", "30", "--hash"});
        return run.output.substr(run.output.find("hash "));
    };
    const std::string from_cache = hash();
    std::filesystem::remove_all(in_folder("kept"));
    EXPECT_EQ(hash(), from_cache) << "a kept wind changes nothing";
    EXPECT_TRUE(std::filesystem::exists(in_folder("kept")));

    std::string text = kHouse;
    const auto change = [&](const std::string& from, const std::string& to)
    { text.replace(text.find(from), from.size(), to); };
    change("source = \"solve\"\nspeed_m_s = 5\ncell_m = 2\ncache_folder = \"kept\"",
           "source = \"file\"\nwinds_file = \"wind.nc\"\nturbulence_file = \"wind.nc\"");
    const Finished from_file = run_command({"run", write("file.toml", text), "--headless", "--steps", "30"});
    EXPECT_EQ(from_file.exit_code, 0) << from_file.error;
}

TEST_F(Command, WindShowsItsResidualOnATerminal)
{
    Launch launch;
    launch.arguments = {"wind", write("house.toml", kHouse), "-o", in_folder("wind.nc"), "--method", "sor"};
    launch.error_on_terminal = true;
    const Finished shown = run_command(launch);
    EXPECT_EQ(shown.exit_code, 0);
    EXPECT_THAT(shown.error, HasSubstr("residual"));
    EXPECT_THAT(shown.error, HasSubstr(" s"));
    EXPECT_THAT(shown.output, HasSubstr("over-relaxation"));
}

TEST_F(Command, WindSaysWhatItCannotWrite)
{
    const std::string scene = small_scene();
    const Finished formula = run_command({"wind", scene, "-o", in_folder("wind.nc")});
    EXPECT_EQ(formula.exit_code, 2);
    EXPECT_THAT(formula.error, HasSubstr("solve"));
    EXPECT_EQ(run_command({"wind", scene}).exit_code, 2) << "no output named";
    const std::string house = write("house.toml", kHouse);
    const Finished nowhere = run_command({"wind", house, "-o", "/proc/none/wind.nc"});
    EXPECT_EQ(nowhere.exit_code, 2);
    EXPECT_THAT(nowhere.error, HasSubstr("/proc/none/wind.nc"));
    EXPECT_EQ(run_command({"wind", house, "-o", in_folder("w.nc"), "--method", "magic"}).exit_code, 2);
}

}  // namespace

}  // namespace spindrift::test
