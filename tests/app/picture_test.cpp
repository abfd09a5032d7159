// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <sstream>
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

TEST_F(Drawing, LowRangeStandsOnTheLeft)
{
    const std::string bright = write("bright.toml", read(small_scene()) + R"(
exposure = 2.5
[bloom]
weight = 0.4
[display]
tone = "reinhard"
dither = false
)");
    const auto picture = [&](const std::string& name, std::vector<std::string> more)
    {
        more.insert(more.begin(), {"run", bright, "--headless", "--frames", "1", "--out", in_folder(name)});
        const Finished run = run_command(more);
        EXPECT_EQ(run.exit_code, 0) << run.error;
        return image::read_png(in_folder(name));
    };
    const image::Image8 alone = picture("alone.png", {}), both = picture("both.png", {"--beside-ldr"});
    ASSERT_EQ(both.width, 2 * 96);
    std::size_t differing = 0;
    for (std::size_t y = 0; y < 64; ++y)
        for (std::size_t x = 0; x < 96 * 3; ++x)
        {
            ASSERT_EQ(both.rgb[y * 192 * 3 + 96 * 3 + x], alone.rgb[y * 96 * 3 + x]);
            differing += both.rgb[y * 192 * 3 + x] != alone.rgb[y * 96 * 3 + x] ? 1 : 0;
        }
    EXPECT_GT(differing, 1000U);
    const Finished exr =
        run_command({"run", bright, "--headless", "--beside-ldr", "--out", in_folder("x.exr")});
    EXPECT_EQ(exr.exit_code, 2);
    EXPECT_THAT(exr.error,
                testing::HasSubstr("--beside-ldr compares what is shown, not light; use .png or .mp4"));
}

TEST_F(Drawing, StatisticsCountABloomThatFoundNothingAsLeftOut)
{
    const std::string scene = read(small_scene()) +
                              "\n[bloom]\nweight = 0.1\nthreshold = 1000\n"
                              "ceiling = 2000\n[[light]]\nkind = \"point\"\n"
                              "position_m = [5, 5, 5]\nintensity_w_sr = [1, 1, 1]\n";
    const std::string stats = in_folder("bloom.json");
    const Finished run =
        run_command({"run", write("bloom.toml", scene), "--headless", "--frames", "2", "--size", "64x36",
                     "--particles", "500", "--out", in_folder("bloom.png"), "--stats", stats});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const nlohmann::json passes = nlohmann::json::parse(read(stats)).at("passes");
    const auto bloom =
        std::ranges::find_if(passes, [](const nlohmann::json& pass) { return pass.at("pass") == "bloom"; });
    ASSERT_NE(bloom, passes.end());
    EXPECT_EQ(bloom->at("frames_run"), 0);
    EXPECT_EQ(bloom->at("frames_skipped"), 2);
    EXPECT_THAT(bloom->at("skipped_because")[0].get<std::string>(),
                testing::HasSubstr("nothing in the picture was bright"));
}

TEST_F(Drawing, LogsLuminanceOfPixels)
{
    const std::string calibrated = write("calibrated.toml", read(small_scene()) + R"(
[display]
tone = "calibrated"
unit_cd_m2 = 100
white_cd_m2 = 400
black_cd_m2 = 0.2
)");
    const auto run = [&](const std::string& scene, const std::string& pixel)
    {
        return run_command({"run", scene, "--headless", "--frames", "2", "--out", in_folder("x.png"),
                            "--luminance", in_folder("l.csv"), "--pixel", pixel, "--pixel", "95,63"});
    };
    const Finished done = run(calibrated, "3,2");
    ASSERT_EQ(done.exit_code, 0) << done.error;
    std::istringstream table(read(in_folder("l.csv")));
    std::string line;
    std::getline(table, line);
    EXPECT_EQ(line, "frame,time_s,x,y,scene_cd_m2,display_cd_m2");
    int lines = 0;
    for (; std::getline(table, line); ++lines)
    {
        int frame = -1, x = -1, y = -1;
        double time_s = -1, sent = -1, shown = -1;
        ASSERT_EQ(std::sscanf(line.c_str(), "%d,%lf,%d,%d,%lf,%lf", &frame, &time_s, &x, &y, &sent, &shown),
                  6);
        EXPECT_EQ(frame, lines / 2);
        EXPECT_NEAR(time_s, frame * 0.05, 1e-6);
        EXPECT_EQ(x, lines % 2 == 0 ? 3 : 95);
        EXPECT_GT(sent, 10);
        EXPECT_NEAR(shown, sent, 0.02 * sent) << "the display shows cd/m2 as they are";
    }
    EXPECT_EQ(lines, 4);
    EXPECT_THAT(run(calibrated, "96,2").error,
                testing::HasSubstr("--pixel 96,2 lies outside of the picture; use 0 to 95 and 0 to 63"));
    EXPECT_THAT(run(calibrated, "a,2").error, testing::HasSubstr("a,2 is no pixel; use COLUMN,ROW"));
    EXPECT_THAT(run(small_scene(), "3,2").error, testing::HasSubstr("is not calibrated"));
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

TEST_F(Drawing, SortsAlongACameraPathAreHeldAgainstThePictureInExactOrder)
{
    const std::string file = in_folder("t.json");
    const Finished run = run_command({"sorts", "--scene", small_scene(), "--frames", "4", "--backend", "cpu",
                                      "--sort-passes", "1", "--out", file});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const json study = json::parse(read(file));
    EXPECT_NE(study.at("pictures_by"), "");
    ASSERT_FALSE(study.at("rows").empty());
    for (const json& row : study.at("rows"))
    {
        SCOPED_TRACE(row.dump());
        EXPECT_EQ(row.at("input"), "camera path of small");
        EXPECT_GT(row.at("pairs"), 1000);
        const double error = row.at("image_relative_l2");
        const bool passes = !row.at("passes_per_frame").is_null();
        if (row.at("key_bits") == 32 && !passes && row.at("sort") != "none")
        {
            EXPECT_EQ(error, 0);
        }
        const double inversions = row.at("inversion_fraction");
        if (passes || row.at("sort") == "none")
        {
            EXPECT_GT(inversions, 1e-4);
        }
        if (row.at("sort") == "none")
        {
            EXPECT_GT(error, 0) << "order shows in the picture";
        }
        if (inversions == 0)
        {
            EXPECT_EQ(error, 0);
        }
        EXPECT_LT(error, 0.5);
        EXPECT_GE(row.at("image_relative_l2_worst"), error);
    }
}

TEST_F(Drawing, AutoSaysWhichSortItTook)
{
    ASSERT_EQ(draw({"--out", in_folder("a.png"), "--stats", in_folder("s.json"), "--backend", "cpu",
                    "--frames", "1"})
                  .exit_code,
              0);
    EXPECT_EQ(json::parse(read(in_folder("s.json"))).at("draw_list").at("sort"), "radix");
}

TEST_F(Drawing, PassesDrawWholeFrames)
{
    ASSERT_EQ(draw({"--out", in_folder("p.png"), "--stats", in_folder("s.json"), "--sort", "passes",
                    "--sort-passes", "12"})
                  .exit_code,
              0);
    const json list = json::parse(read(in_folder("s.json"))).at("draw_list");
    EXPECT_EQ(list.at("sort"), "bitonic-passes");
    EXPECT_EQ(list.at("passes_per_frame"), 12);
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
