// SPDX-License-Identifier: MIT
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "gl/context.h"
#include "image/write.h"
#include "tests/app/child_process.h"
#include "tests/app/command_fixture.h"

namespace spindrift::test
{

namespace
{

using nlohmann::json;

/// Runs of the command that draw: they need a headless GL context.
class Drawing : public Command
{
  protected:
    void SetUp() override
    {
        static const std::string why_not = []
        {
            try
            {
                gl::make_headless_context();
                return std::string();
            }
            catch (const Error& e)
            {
                return std::string(e.what());
            }
        }();
        if (!why_not.empty()) GTEST_SKIP() << why_not;
    }

    Finished draw(std::vector<std::string> more)
    {
        more.insert(more.begin(), {"run", small_scene(), "--headless"});
        return run_command(more);
    }
};

TEST_F(Drawing, OneRunFeedsSeveralFiles)
{
    const Finished run = draw({"--out", in_folder("f_%03d.png"), "--out", in_folder("last.png"), "--out",
                               in_folder("last.exr"), "--stats", in_folder("s.json"), "--frames", "3"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const image::Image8 last = image::read_png(in_folder("last.png"));
    EXPECT_EQ(last.width, 96);
    EXPECT_EQ(last.height, 64);
    EXPECT_EQ(image::read_png(in_folder("f_002.png")).rgb, last.rgb);
    EXPECT_NE(image::read_png(in_folder("f_000.png")).rgb, last.rgb);
    EXPECT_EQ(image::read_exr(in_folder("last.exr")).width, 96);

    const json stats = json::parse(read(in_folder("s.json")));
    EXPECT_EQ(stats.at("frames"), 3);
    EXPECT_EQ(stats.at("gl_errors"), "");
    EXPECT_NE(stats.at("gl").at("renderer"), "");
    for (const char* stage : {"step", "cull", "sort", "draw calls", "read-back", "encode", "frame"})
        EXPECT_TRUE(stats.at("stages_ms").contains(stage)) << stage;
    EXPECT_FALSE(stats.at("passes").empty());
    EXPECT_GT(stats.at("draw_list").at("drawn_median"), 0);
}

TEST_F(Drawing, DoesNotChangeTheSimulation)
{
    const Finished drawn = draw({"--out", in_folder("x.png"), "--hash"});
    const Finished simulated = draw({"--hash"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.error;
    EXPECT_EQ(drawn.output.substr(drawn.output.find("hash ")),
              simulated.output.substr(simulated.output.find("hash ")));
}

TEST_F(Drawing, StagedCopyGivesTheSamePicture)
{
    ASSERT_EQ(draw({"--out", in_folder("on.png"), "--interop", "on"}).exit_code, 0);
    ASSERT_EQ(draw({"--out", in_folder("off.png"), "--interop", "off"}).exit_code, 0);
    EXPECT_EQ(image::read_png(in_folder("on.png")).rgb, image::read_png(in_folder("off.png")).rgb);
}

TEST_F(Drawing, ExactSortsGiveTheSamePicture)
{
    ASSERT_EQ(draw({"--out", in_folder("radix.png"), "--sort", "radix"}).exit_code, 0);
    ASSERT_EQ(draw({"--out", in_folder("std.png"), "--sort", "std"}).exit_code, 0);
    EXPECT_EQ(image::read_png(in_folder("radix.png")).rgb, image::read_png(in_folder("std.png")).rgb);
}

TEST_F(Drawing, InterruptLeavesWholeFiles)
{
    Launch launch;
    launch.arguments = {"run",      small_scene(), "--headless",       "--frames",
                        "10000000", "--stats",     in_folder("s.json")};
    for (const char* file : {"film.mp4", "last.png", "f_%d.exr"})
        launch.arguments.insert(launch.arguments.end(), {"--out", in_folder(file)});
    launch.interrupt_when_there_is = in_folder("f_2.exr");
    const Finished run = run_command(launch);
    EXPECT_EQ(run.exit_code, 130) << run.error;
    EXPECT_EQ(image::read_png(in_folder("last.png")).width, 96);
    const json stats = json::parse(read(in_folder("s.json")));
    EXPECT_TRUE(stats.at("interrupted"));
    const std::size_t frames = stats.at("frames");
    EXPECT_GE(frames, 3U);
    EXPECT_EQ(files(), 4 + frames)
        << "scene, film, picture, statistics, one EXR a frame, and nothing half-made";
    EXPECT_EQ(image::read_exr(in_folder("f_" + std::to_string(frames - 1) + ".exr")).width, 96);
    EXPECT_TRUE(stats.at("counts").at("balance").at("holds"));
    // A whole film has its index: without it players refuse it.
    EXPECT_THAT(read(in_folder("film.mp4")), testing::HasSubstr("moov"));
}

TEST_F(Drawing, FullDiskLeavesNothingHalfMade)
{
    Launch launch;
    launch.arguments = {"run",      small_scene(), "--headless", "--size",          "640x480",
                        "--frames", "2",           "--out",      in_folder("x.exr")};
    launch.largest_file_bytes = 20000;
    const Finished run = run_command(launch);
    EXPECT_EQ(run.exit_code, 2) << run.error;
    EXPECT_EQ(files(), 1U) << "only the scene";
    EXPECT_FALSE(std::filesystem::exists(in_folder("x.exr")));
}

TEST_F(Drawing, CalibratesOnTheBlackSheetAndRefusesOtherScenes)
{
    const Finished run = run_command({"calibrate", "--most", "500", "--frames", "1", "--csv",
                                      in_folder("c.csv"), "--plot", in_folder("c.svg")});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    EXPECT_THAT(run.output, testing::HasSubstr("RMS residual"));
    EXPECT_THAT(read(in_folder("c.csv")), testing::StartsWith("particles_per_s,grey,"));
    EXPECT_THAT(read(in_folder("c.csv")), testing::HasSubstr("\n500,"));
    EXPECT_THAT(read(in_folder("c.svg")), testing::EndsWith("</svg>\n"));
    const Finished other = run_command({"calibrate", small_scene()});
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_THAT(other.error, testing::HasSubstr("use a scene like sheet"));
}

}  // namespace

}  // namespace spindrift::test
