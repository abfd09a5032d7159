// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "image/compare.h"
#include "image/write.h"
#include "tests/image/temporary_folder.h"

namespace spindrift::image
{
namespace
{

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

using FrameFiles = TemporaryFolder;

Image8 grey(int width, int height, int level)
{
    return {width, height,
            std::vector<unsigned char>(static_cast<std::size_t>(width * height * 3),
                                       static_cast<unsigned char>(level))};
}

Image linear(int width, int height, float value)
{
    Image out(width, height);
    std::fill(out.rgba.begin(), out.rgba.end(), value);
    return out;
}

std::string output_of(const std::string& command)
{
    FILE* pipe = ::popen(command.c_str(), "r");
    std::string text;
    char chunk[256];
    while (pipe != nullptr && ::fgets(chunk, sizeof chunk, pipe) != nullptr) text += chunk;
    if (pipe != nullptr) ::pclose(pipe);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
}

std::string probe(const std::filesystem::path& file, const std::string& entries)
{
    return output_of("ffprobe -v error -count_frames -select_streams v:0 -show_entries stream=" + entries +
                     " -of csv=p=0 '" + file.string() + "'");
}

TEST_F(FrameFiles, SinglePngIsTheLastFrame)
{
    const auto writer = make_frame_writer(at("a.PNG").string(), 4, 3, 30);
    EXPECT_FALSE(writer->wants_linear());
    EXPECT_TRUE(writer->keeps_last_only());
    for (int level : {10, 20, 30}) writer->add(grey(4, 3, level));
    EXPECT_THAT(entries(), IsEmpty());
    writer->finish();
    EXPECT_THAT(entries(), ElementsAre("a.PNG"));
    EXPECT_EQ(read_png(at("a.PNG")).rgb[0], 30);
}

TEST_F(FrameFiles, SequencesNumberFromZero)
{
    const auto png = make_frame_writer(at("p_%04d.png").string(), 4, 3, 30);
    const auto exr = make_frame_writer(at("e_%d.exr").string(), 4, 3, 30);
    EXPECT_TRUE(exr->wants_linear());
    EXPECT_FALSE(exr->keeps_last_only());
    for (int i = 0; i < 3; ++i)
    {
        png->add(grey(4, 3, i));
        exr->add(linear(4, 3, static_cast<float>(i)));
    }
    png->finish();
    exr->finish();
    EXPECT_THAT(entries(),
                ElementsAre("e_0.exr", "e_1.exr", "e_2.exr", "p_0000.png", "p_0001.png", "p_0002.png"));
    EXPECT_EQ(read_png(at("p_0002.png")).rgb[0], 2);
    EXPECT_EQ(read_exr(at("e_2.exr")).rgba[0], 2.0F);
}

TEST_F(FrameFiles, RefusesOtherPatterns)
{
    for (const char* name : {"%s.png", "%%.png", "%d_%d.png", "%.png", "%0d.png", "%-4d.png", "%ld.png",
                             "%04x.png", "%012d.png", "a%", "a_%d.mp4", "a.jpg", "a", "a."})
        EXPECT_THAT([&] { make_frame_writer(at(name).string(), 4, 4, 30); },
                    ThrowsMessage<Error>(HasSubstr(name)));
    EXPECT_THROW(make_frame_writer("", 4, 4, 30), Error);
    EXPECT_THROW(make_frame_writer(at("a.png").string(), 0, 4, 30), Error);
    EXPECT_THROW(make_frame_writer(at("a.mp4").string(), 4, 4, 0), Error);
    EXPECT_THROW(make_frame_writer(at("a.mp4").string(), 4, 4, std::numeric_limits<double>::quiet_NaN()),
                 Error);
    EXPECT_THAT(entries(), IsEmpty());
}

TEST_F(FrameFiles, UnwritablePlaceShowsBeforeTheFirstFrame)
{
    std::ofstream(at("flat")) << "x";
    for (const char* name : {"flat/a.png", "flat/a_%d.exr", "flat/a.mp4"})
        EXPECT_THAT([&] { make_frame_writer(at(name).string(), 4, 4, 30); },
                    ThrowsMessage<Error>(HasSubstr("flat/a")));
}

TEST_F(FrameFiles, NoFrameNoFile)
{
    for (const char* name : {"a.png", "a_%d.png", "a.exr", "a.mp4"})
        make_frame_writer(at(name).string(), 16, 16, 30)->finish();
    EXPECT_THAT(entries(), IsEmpty());
}

TEST_F(FrameFiles, FrameOfAnotherSizeIsAnError)
{
    for (const char* name : {"a.png", "a_%d.png", "a.mp4"})
        EXPECT_THAT([&] { make_frame_writer(at(name).string(), 16, 16, 30)->add(grey(8, 16, 0)); },
                    ThrowsMessage<Error>(HasSubstr("8x16")));
    EXPECT_THAT(entries(), IsEmpty());
}

TEST_F(FrameFiles, VideoHoldsEveryFrame)
{
    const auto writer = make_frame_writer(at("a 'b:c.mp4").string(), 64, 48, 25);
    for (int i = 0; i < 17; ++i) writer->add(grey(64, 48, i * 15));
    writer->finish();
    ASSERT_THAT(entries(), ElementsAre("a 'b:c.mp4"));
    std::filesystem::rename(at("a 'b:c.mp4"), at("a.mp4"));
    EXPECT_EQ(probe(at("a.mp4"), "codec_name,width,height,pix_fmt,color_space,r_frame_rate,nb_read_frames"),
              "h264,64,48,yuv420p,bt709,25/1,17");
}

TEST_F(FrameFiles, VideoKeepsColour)
{
    Image8 frame = grey(32, 32, 0);
    for (std::size_t i = 0; i < frame.rgb.size(); i += 3)
        frame.rgb[i] = 200, frame.rgb[i + 1] = 120, frame.rgb[i + 2] = 40;
    const auto writer = make_frame_writer(at("a.mp4").string(), 32, 32, 30);
    for (int i = 0; i < 3; ++i) writer->add(frame);
    writer->finish();
    output_of("ffmpeg -v error -i '" + at("a.mp4").string() + "' -frames:v 1 '" + at("a.png").string() + "'");
    EXPECT_LE(compare(read_png(at("a.png")), frame, 3).worst, 3);
}

TEST_F(FrameFiles, VideoOfOddSizeIsPadded)
{
    const auto writer = make_frame_writer(at("a.mp4").string(), 33, 17, 29.97);
    for (int i = 0; i < 5; ++i) writer->add(grey(33, 17, 128));
    writer->finish();
    EXPECT_EQ(probe(at("a.mp4"), "width,height,nb_read_frames"), "34,18,5");
}

TEST_F(FrameFiles, VideoInterruptedLeavesNothing)
{
    {
        const auto writer = make_frame_writer(at("a.mp4").string(), 64, 48, 30);
        writer->add(grey(64, 48, 7));
        EXPECT_EQ(entries().size(), 1U);  // the file aside
    }
    EXPECT_THAT(entries(), IsEmpty());
}

TEST_F(FrameFiles, VideoOutlivesCtrlCAtTheTerminal)
{
    // What a terminal does: SIGINT for the whole foreground group, here a group of our own.
    const pid_t group_before = ::getpgrp();
    if (::setpgid(0, 0) != 0 && ::getpgrp() != ::getpid())
        GTEST_SKIP() << "no process group of our own to be had";
    const auto previous = ::signal(SIGINT, [](int) {});
    const auto writer = make_frame_writer(at("a.mp4").string(), 64, 48, 30);
    for (int i = 0; i < 4; ++i) writer->add(grey(64, 48, 7));
    ::kill(0, SIGINT);
    for (int i = 0; i < 4; ++i) writer->add(grey(64, 48, 9));
    writer->finish();
    ::signal(SIGINT, previous);
    ::setpgid(0, group_before);
    EXPECT_EQ(probe(at("a.mp4"), "nb_read_frames"), "8");
}

/// PATH of this process replaced by one folder for a test.
class OnlyPath
{
  public:
    explicit OnlyPath(const std::filesystem::path& folder) : previous_(::getenv("PATH"))
    {
        ::setenv("PATH", folder.c_str(), 1);
    }
    ~OnlyPath() { ::setenv("PATH", previous_.c_str(), 1); }
    OnlyPath(const OnlyPath&) = delete;
    OnlyPath& operator=(const OnlyPath&) = delete;

  private:
    std::string previous_;
};

TEST_F(FrameFiles, MissingEncoderIsNamed)
{
    std::filesystem::create_directory(at("bin"));
    const OnlyPath path(at("bin"));
    EXPECT_THAT([&] { make_frame_writer(at("a.mp4").string(), 16, 16, 30); },
                ThrowsMessage<Error>(AllOf(HasSubstr("a.mp4"), HasSubstr("install the package ffmpeg"))));
    EXPECT_THAT(entries(), ElementsAre("bin"));
}

TEST_F(FrameFiles, FailingEncoderIsQuoted)
{
    std::filesystem::create_directory(at("bin"));
    std::ofstream(at("bin/ffmpeg")) << "#!/bin/sh\necho 'no such encoder here' >&2\nexit 3\n";
    std::filesystem::permissions(at("bin/ffmpeg"), std::filesystem::perms::owner_all);
    const OnlyPath path(at("bin"));
    const auto encode = [&]
    {
        const auto writer = make_frame_writer(at("a.mp4").string(), 640, 480, 30);
        for (int i = 0; i < 100; ++i)
            writer->add(grey(640, 480, i));  // more than a socket holds: the writer meets EPIPE
        writer->finish();
    };
    EXPECT_THAT(encode, ThrowsMessage<Error>(AllOf(HasSubstr("code 3"), HasSubstr("no such encoder here"))));
    EXPECT_THAT(entries(), ElementsAre("bin"));
}

TEST(Compare, KnowsEqualPictures)
{
    const Difference same = compare(linear(4, 4, 0.25F), linear(4, 4, 0.25F), 0);
    EXPECT_EQ(same.relative_l2, 0);
    EXPECT_EQ(same.worst, 0);
    EXPECT_EQ(same.share_above, 0);
}

TEST(Compare, GivesKnownFigures)
{
    Image a = linear(10, 10, 1.0F);
    const Image b = linear(10, 10, 1.0F);
    a.pixel(3, 4)[2] = 1.5F;
    a.pixel(3, 4)[3] = 99;  // alpha does not count
    a.pixel(0, 0)[0] = 1.01F;
    const Difference off = compare(a, b, 0.1);
    EXPECT_DOUBLE_EQ(off.worst, 0.5);
    EXPECT_DOUBLE_EQ(off.share_above, 0.01);
    EXPECT_NEAR(off.relative_l2, std::sqrt((0.25 + 0.0001) / 300), 1e-8);
    EXPECT_NEAR(off.rest_relative_l2, std::sqrt(0.0001 / 300), 1e-8);

    Image8 c = grey(10, 10, 100);
    c.rgb[5] = 104;
    EXPECT_EQ(compare(c, grey(10, 10, 100), 3).worst, 4);
    EXPECT_DOUBLE_EQ(compare(c, grey(10, 10, 100), 3).share_above, 0.01);
    EXPECT_EQ(compare(c, grey(10, 10, 100), 4).share_above, 0);
}

TEST(Compare, NeverPassesANan)
{
    Image a = linear(4, 4, 1.0F);
    a.pixel(1, 1)[0] = std::numeric_limits<float>::quiet_NaN();
    for (const Difference& off :
         {compare(a, linear(4, 4, 1.0F), 1e9), compare(linear(4, 4, 1.0F), a, 1e9), compare(a, a, 1e9)})
    {
        EXPECT_TRUE(std::isinf(off.relative_l2));
        EXPECT_TRUE(std::isinf(off.worst));
        EXPECT_DOUBLE_EQ(off.share_above, 1.0 / 16);
    }
    EXPECT_TRUE(std::isinf(compare(linear(2, 2, 1), linear(2, 2, 0), 0).relative_l2));
    EXPECT_THROW(compare(linear(2, 2, 1), linear(2, 3, 1), 0), Error);
}

}  // namespace
}  // namespace spindrift::image
