// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/child_process.h"
#include "tests/app/command_fixture.h"
#include "tests/scene/temporary_folder.h"

namespace spindrift::test
{

namespace
{

using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

std::string hash_of(const Finished& run)
{
    const std::size_t at = run.output.find("hash ");
    return at == std::string::npos ? "no hash in: " + run.output + run.error : run.output.substr(at + 5, 16);
}

/// One line that begins with the program's name: nothing else may be on stderr.
void expect_one_clear_line(const Finished& run)
{
    EXPECT_EQ(run.exit_code, 2) << run.error;
    EXPECT_EQ(std::count(run.error.begin(), run.error.end(), '\n'), 1) << run.error;
    EXPECT_EQ(run.error.rfind("spindrift: ", 0), 0U) << run.error;
}

TEST_F(Command, HelpNamesEverySubcommandAndGivesExamples)
{
    const Finished help = run_command({"--help"});
    EXPECT_EQ(help.exit_code, 0);
    for (const char* word : {"run", "wind", "explain", "sorts", "info", "scenes", "Examples:", "130"})
        EXPECT_THAT(help.output, HasSubstr(word));
    EXPECT_EQ(help.error, "");
}

TEST_F(Command, HelpOfRunNamesEveryOption)
{
    const Finished help = run_command({"run", "--help"});
    EXPECT_EQ(help.exit_code, 0);
    for (const char* option :
         {"--headless", "--frames",        "--out",           "--size",  "--fps",        "--backend",
          "--threads",  "--simd",          "--particles",     "--sort",  "--depth-bits", "--sort-passes",
          "--seed",     "--wind",          "--turbulence",    "--stats", "--hash",       "--interop",
          "--steps",    "--save-snapshot", "--load-snapshot", "radix"})
        EXPECT_THAT(help.output, HasSubstr(option));
}

TEST_F(Command, WrongArgumentsAreBadInput)
{
    const std::string scene = small_scene();
    const std::vector<std::vector<std::string>> wrong = {
        {},
        {"fly"},
        {"run"},
        {"run", scene, "--headless", "--colour"},
        {"run", scene, "--headless", "--threads", "-1"},
        {"run", scene, "--headless", "--threads", "two"},
        {"run", scene, "--headless", "--size", "0x10"},
        {"run", scene, "--headless", "--size", "10x10x10"},
        {"run", scene, "--headless", "--fps", "nan"},
        {"run", scene, "--headless", "--fps", "0"},
        {"run", scene, "--headless", "--frames", "0"},
        {"run", scene, "--headless", "--particles", "-5"},
        {"run", scene, "--headless", "--particles", "many"},
        {"run", scene, "--headless", "--depth-bits", "20"},
        {"run", scene, "--headless", "--simd", "sse"},
        {"run", scene, "--headless", "--backend", "vulkan"},
        {"run", scene, "--headless", "--interop", "maybe"},
    };
    for (const auto& arguments : wrong)
    {
        SCOPED_TRACE(testing::PrintToString(arguments));
        expect_one_clear_line(run_command(arguments));
    }
}

TEST_F(Command, ContradictingOptionsAreNamed)
{
    const std::string scene = small_scene();
    expect_one_clear_line(run_command({"run", scene, "--out", in_folder("x.png")}));
    expect_one_clear_line(run_command({"run", scene, "--steps", "4"}));
    expect_one_clear_line(
        run_command({"run", scene, "--headless", "--steps", "4", "--out", in_folder("x.png")}));
    expect_one_clear_line(run_command({"run", scene, "--headless", "--interop", "on"}));
}

TEST_F(Command, CudaThatThisBuildLacksIsAnErrorAndNoSwap)
{
    const Finished run =
        run_command({"run", small_scene(), "--headless", "--steps", "1", "--backend", "cuda"});
    expect_one_clear_line(run);
    EXPECT_THAT(run.error, HasSubstr("--backend cpu"));
}

TEST_F(Command, BadScenesSayFileLineKeyAndWhatIsAllowed)
{
    const std::string good = read(small_scene());
    const auto broken = [&](const std::string& from, const std::string& to)
    {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        const Finished run = run_command({"run", write("broken.toml", text), "--headless", "--steps", "1"});
        expect_one_clear_line(run);
        EXPECT_THAT(run.error, HasSubstr("broken.toml:")) << to;
        return run.error;
    };
    EXPECT_THAT(broken("speed_m_s = 6", "speed_m_s = -6"), HasSubstr("speed_m_s"));
    EXPECT_THAT(broken("speed_m_s = 6", "speed_m_s = nan"), HasSubstr("speed_m_s"));
    EXPECT_THAT(broken("speed_m_s = 6", "sped_m_s = 6"), HasSubstr("speed_m_s"));
    EXPECT_THAT(broken("speed_m_s = 6", "speed_m_s = \"fast\""), HasSubstr("speed_m_s"));
    EXPECT_THAT(broken("capacity = 20000", "capacity = 1000000000000"),
                AnyOf(HasSubstr("GB"), HasSubstr("TB")));
    EXPECT_THAT(broken("max_m = [40, 40, 20]", "max_m = [40, 40, 0]"), HasSubstr("max_m"));
}

TEST_F(Command, MissingFilesAndFoldersAreNamed)
{
    const Finished missing = run_command({"run", in_folder("none.toml"), "--headless"});
    expect_one_clear_line(missing);
    EXPECT_THAT(missing.error, HasSubstr("none.toml"));
    expect_one_clear_line(run_command({"run", in_folder(""), "--headless"}));
    const Finished name = run_command({"run", "no-such-town", "--headless"});
    expect_one_clear_line(name);
    EXPECT_THAT(name.error, HasSubstr("no-such-town"));
}

TEST_F(Command, WindowWithoutDisplayNamesHeadless)
{
    Launch launch;
    launch.arguments = {"run", small_scene()};
    launch.unset = {"DISPLAY", "WAYLAND_DISPLAY"};
    const Finished run = run_command(launch);
    expect_one_clear_line(run);
    EXPECT_THAT(run.error, HasSubstr("--headless"));
}

TEST_F(Command, HashDoesNotDependOnThreadsOrSimd)
{
    const std::string scene = small_scene();
    const std::vector<std::string> base = {"run", scene, "--headless", "--steps", "40", "--hash"};
    const auto with = [&](std::vector<std::string> more)
    {
        more.insert(more.begin(), base.begin(), base.end());
        const Finished run = run_command(more);
        EXPECT_EQ(run.exit_code, 0) << run.error;
        return hash_of(run);
    };
    const std::string hash = with({});
    EXPECT_EQ(hash.size(), 16U);
    for (const char* threads : {"1", "2", "7"}) EXPECT_EQ(with({"--threads", threads}), hash) << threads;
    Launch without_gl;
    without_gl.arguments = {"info"};
    without_gl.environment = {"__EGL_VENDOR_LIBRARY_DIRS=/nonexistent", "LIBGL_DRIVERS_PATH=/nonexistent"};
    const std::string info = run_command(without_gl).output;
    ASSERT_NE(info.find("scalar"), std::string::npos) << info;
    for (const char* simd : {"scalar", "avx2", "avx512"})
    {
        if (info.find(simd) == std::string::npos) continue;
        EXPECT_EQ(with({"--simd", simd}), hash) << simd;
    }
    EXPECT_NE(with({"--seed", "8"}), hash);
}

TEST_F(Command, HashOfFramesIsThatOfTheirSteps)
{
    // 8 frames at 20 per second: the last is shown at 0.35 s, which is 7 steps of 0.05 s.
    const std::string scene = small_scene();
    const Finished frames = run_command({"run", scene, "--headless", "--frames", "8", "--hash"});
    const Finished steps = run_command({"run", scene, "--headless", "--steps", "7", "--hash"});
    EXPECT_EQ(frames.exit_code, 0) << frames.error;
    EXPECT_EQ(hash_of(frames), hash_of(steps));
}

TEST_F(Command, SnapshotGoesOnWithTheSameHash)
{
    const std::string scene = small_scene();
    const std::string snapshot = in_folder("half.snap");
    const Finished whole = run_command({"run", scene, "--headless", "--steps", "30", "--hash"});
    const Finished first =
        run_command({"run", scene, "--headless", "--steps", "13", "--save-snapshot", snapshot});
    ASSERT_EQ(first.exit_code, 0) << first.error;
    const Finished second =
        run_command({"run", scene, "--headless", "--steps", "17", "--load-snapshot", snapshot, "--hash"});
    EXPECT_EQ(second.exit_code, 0) << second.error;
    EXPECT_EQ(hash_of(second), hash_of(whole));

    const Finished other =
        run_command({"run", scene, "--headless", "--steps", "1", "--seed", "8", "--load-snapshot", snapshot});
    expect_one_clear_line(other);
    std::filesystem::resize_file(snapshot, std::filesystem::file_size(snapshot) / 2);
    expect_one_clear_line(
        run_command({"run", scene, "--headless", "--steps", "1", "--load-snapshot", snapshot}));
}

TEST_F(Command, UnwritableFilesAreFoundBeforeSimulating)
{
    const std::string scene = small_scene();
    std::filesystem::create_directory(in_folder("folder.json"));
    std::filesystem::create_directory(in_folder("folder.png"));
    // So many steps that the test would not come back if the file were tried last.
    const auto refuses = [&](const char* option, const std::string& file, const char* count, const char* n)
    {
        const Finished run = run_command({"run", scene, "--headless", count, n, option, file});
        expect_one_clear_line(run);
        EXPECT_THAT(run.error, HasSubstr(file)) << option;
    };
    for (const std::string& file : {in_folder("folder.json"), std::string("/proc/none/x.json")})
    {
        refuses("--stats", file, "--steps", "1000000000");
        refuses("--save-snapshot", file, "--steps", "1000000000");
    }
    for (const std::string& file :
         {in_folder("folder.png"), in_folder("x.gif"), std::string("/proc/none/x.png")})
        refuses("--out", file, "--frames", "10000000");
}

TEST_F(Command, FullDiskIsAnError)
{
    Launch launch;
    launch.arguments = {"scenes"};
    launch.standard_output = "/dev/full";
    EXPECT_EQ(run_command(launch).exit_code, 2);

    const std::string snapshot = in_folder("s.snap");
    Launch limited;
    limited.arguments = {"run", small_scene(), "--headless", "--steps", "3", "--save-snapshot", snapshot};
    limited.largest_file_bytes = 100000;
    const std::size_t before = files();
    const Finished full = run_command(limited);
    expect_one_clear_line(full);
    EXPECT_THAT(full.error, HasSubstr("s.snap"));
    EXPECT_EQ(files(), before) << "something was left behind";
}

TEST_F(Command, ProgressIsForTerminalsOnly)
{
    Launch launch;
    launch.arguments = {"run", small_scene(), "--headless", "--steps", "20"};
    EXPECT_EQ(run_command(launch).error, "");
    launch.error_on_terminal = true;
    const Finished shown = run_command(launch);
    EXPECT_THAT(shown.error, HasSubstr("20/20 steps"));
    EXPECT_THAT(shown.error, HasSubstr("left"));
}

TEST_F(Command, ExplainNeedsNoGlAndGivesReasons)
{
    Launch launch;
    launch.arguments = {"explain", small_scene()};
    launch.environment = {"__EGL_VENDOR_LIBRARY_DIRS=/nonexistent", "LIBGL_DRIVERS_PATH=/nonexistent"};
    const Finished text = run_command(launch);
    EXPECT_EQ(text.exit_code, 0) << text.error;
    for (const char* word : {"small", "20000", "First frame", "sort", "Memory"})
        EXPECT_THAT(text.output, HasSubstr(word));
    launch.arguments.push_back("--json");
    const Finished json = run_command(launch);
    EXPECT_EQ(json.exit_code, 0) << json.error;
    EXPECT_THAT(json.output, HasSubstr("\"frame\""));
}

TEST_F(Command, InfoSaysWhyThereIsNoGl)
{
    Launch launch;
    launch.arguments = {"info"};
    launch.environment = {"__EGL_VENDOR_LIBRARY_DIRS=/nonexistent", "LIBGL_DRIVERS_PATH=/nonexistent"};
    const Finished info = run_command(launch);
    EXPECT_EQ(info.exit_code, 0) << info.error;
    for (const char* word : {"backend", "cpu", "threads", "scalar", "radix", "libraries"})
        EXPECT_THAT(info.output, HasSubstr(word));
}

TEST_F(Command, ScenesListsTheShippedOnesWithoutAFault)
{
    Launch launch;
    launch.arguments = {"scenes"};
    const Finished scenes = run_command(launch);
    EXPECT_EQ(scenes.exit_code, 0) << scenes.error;
    for (const char* name : {"town", "canyon", "sheet", "calm"}) EXPECT_THAT(scenes.output, HasSubstr(name));
    EXPECT_THAT(scenes.output, Not(HasSubstr("cannot be run"))) << scenes.output;
}

TEST_F(Command, EveryShippedSceneRuns)
{
    std::size_t scenes = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(SPINDRIFT_SOURCE_DIR) / "scenes"))
    {
        if (entry.path().extension() != ".toml") continue;
        ++scenes;
        const std::string scene = entry.path().string();
        const Finished run =
            run_command({"run", scene, "--headless", "--particles", "3000", "--steps", "3", "--hash"});
        // This one blows in a wind field that the command line names.
        const bool without_its_wind = entry.path().stem() == "two-blocks";
        EXPECT_EQ(run.exit_code, without_its_wind ? 2 : 0) << scene << ": " << run.error;
        EXPECT_THAT(run.error, without_its_wind ? HasSubstr("--wind") : HasSubstr("")) << scene;
    }
    EXPECT_GE(scenes, 5U);
}

TEST_F(Command, RealWindFieldBlowsRoundItsBlocks)
{
    const std::filesystem::path winds = scene::optional_data("qes/TwoBuildings_windsWk.nc");
    const std::filesystem::path turbulence = scene::optional_data("qes/TwoBuildings_turbOut.nc");
    if (winds.empty() || turbulence.empty())
        GTEST_SKIP() << "no qes/TwoBuildings_*.nc: set SPINDRIFT_TEST_DATA to a folder that holds them";
    std::vector<std::string> arguments = {"run",    "two-blocks",   "--headless",   "--particles",
                                          "20000",  "--steps",      "20",           "--hash",
                                          "--wind", winds.string(), "--turbulence", turbulence.string()};
    const Finished run = run_command(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.error;
    arguments.insert(arguments.end(), {"--threads", "1", "--simd", "scalar"});
    EXPECT_EQ(hash_of(run_command(arguments)), hash_of(run));
}

}  // namespace

}  // namespace spindrift::test
