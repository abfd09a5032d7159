// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "core/error.h"
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

using PictureFile = TemporaryFolder;

/// Hard to compress, so that a file has about the size of its pixels.
Image8 noise8(int width, int height)
{
    Image8 out{width, height, {}};
    std::uint32_t state = 1;
    for (int i = 0; i < width * height * 3; ++i)
    {
        state = state * 1664525U + 1013904223U;
        out.rgb.push_back(static_cast<unsigned char>(state >> 24U));
    }
    return out;
}

Image ramp(int width, int height)
{
    Image out(width, height);
    for (std::size_t i = 0; i < out.rgba.size(); ++i) out.rgba[i] = static_cast<float>(i) * 0.37F - 3.0F;
    return out;
}

TEST_F(PictureFile, PngComesBackBitForBit)
{
    const Image8 image = noise8(37, 11);
    write_png(at("a.png"), image);
    const Image8 back = read_png(at("a.png"));
    EXPECT_EQ(back.width, 37);
    EXPECT_EQ(back.height, 11);
    EXPECT_EQ(back.rgb, image.rgb);
    EXPECT_THAT(entries(), ElementsAre("a.png"));
}

TEST_F(PictureFile, ExrComesBackWithinHalfPrecision)
{
    const Image image = ramp(33, 7);
    write_exr(at("a.exr"), image);
    const Image back = read_exr(at("a.exr"));
    ASSERT_EQ(back.width, 33);
    ASSERT_EQ(back.height, 7);
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        EXPECT_NEAR(back.rgba[i], image.rgba[i], std::abs(image.rgba[i]) * 0x1p-11F + 0x1p-25F) << i;
}

TEST_F(PictureFile, ExrHoldsTheBrightestHalfInsteadOfInfinity)
{
    Image image(2, 1);
    image.rgba = {1e9F, std::numeric_limits<float>::infinity(), -1e9F, 1, 65504, 6e-8F, 0, 0.5F};
    write_exr(at("a.exr"), image);
    EXPECT_THAT(read_exr(at("a.exr")).rgba,
                testing::Pointwise(testing::FloatNear(1e-9F),
                                   {65504.0F, 65504.0F, -65504.0F, 1.0F, 65504.0F, 0x1p-24F, 0.0F, 0.5F}));
}

TEST_F(PictureFile, ReplacesAnOlderFile)
{
    write_png(at("a.png"), noise8(8, 8));
    write_png(at("a.png"), noise8(4, 2));
    EXPECT_EQ(read_png(at("a.png")).width, 4);
    EXPECT_THAT(entries(), ElementsAre("a.png"));
}

TEST_F(PictureFile, FollowsALinkAndKeepsIt)
{
    write_png(at("real.png"), noise8(8, 8));
    std::filesystem::create_symlink("real.png", at("link.png"));
    write_png(at("link.png"), noise8(4, 2));
    EXPECT_TRUE(std::filesystem::is_symlink(at("link.png")));
    EXPECT_EQ(read_png(at("real.png")).width, 4);
}

TEST_F(PictureFile, MakesMissingFolders)
{
    write_png(at("new/er/a.png"), noise8(4, 2));
    EXPECT_EQ(read_png(at("new/er/a.png")).height, 2);
}

TEST_F(PictureFile, SaysThatAFolderIsInTheWay)
{
    std::filesystem::create_directory(at("a.png"));
    EXPECT_THAT([&] { write_png(at("a.png"), noise8(4, 2)); },
                ThrowsMessage<Error>(AllOf(HasSubstr("a.png"), HasSubstr("folder"))));
    EXPECT_THAT([&] { write_exr(at("a.png"), ramp(4, 2)); }, ThrowsMessage<Error>(HasSubstr("folder")));
    EXPECT_THAT([&] { write_png(at("b/"), noise8(4, 2)); }, ThrowsMessage<Error>(HasSubstr("folder")));
    EXPECT_THAT(entries(), ElementsAre("a.png"));
}

TEST_F(PictureFile, SaysThatAFileStandsWhereAFolderIsNeeded)
{
    std::ofstream(at("flat")) << "x";
    EXPECT_THAT([&] { write_png(at("flat/a.png"), noise8(4, 2)); },
                ThrowsMessage<Error>(HasSubstr("flat/a.png")));
    EXPECT_THAT(entries(), ElementsAre("flat"));
}

TEST_F(PictureFile, NeverReplacesADevice)
{
    EXPECT_THAT([] { write_png("/dev/full", noise8(4, 2)); },
                ThrowsMessage<Error>(HasSubstr("not a regular file")));
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(PictureFile, SaysThatAFolderIsNotWritable)
{
    if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
    std::filesystem::create_directory(at("shut"));
    std::filesystem::permissions(at("shut"),
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    EXPECT_THAT([&] { write_png(at("shut/a.png"), noise8(4, 2)); },
                ThrowsMessage<Error>(HasSubstr("ermission denied")));
}

/// Lets no file of this process and its children grow beyond a size, as a full disk would.
class FileSizeLimit
{
  public:
    explicit FileSizeLimit(rlim_t bytes)
    {
        previous_handler_ = ::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &previous_);
        const rlimit limit{bytes, previous_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit()
    {
        ::setrlimit(RLIMIT_FSIZE, &previous_);
        ::signal(SIGXFSZ, previous_handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit previous_{};
    void (*previous_handler_)(int);
};

TEST_F(PictureFile, LeavesTheOlderFileWhenTheDiskIsFull)
{
    write_png(at("a.png"), noise8(4, 2));
    {
        const FileSizeLimit limit(4096);
        EXPECT_THAT([&] { write_png(at("a.png"), noise8(100, 100)); },
                    ThrowsMessage<Error>(AllOf(HasSubstr("a.png"), HasSubstr("too large"))));
        EXPECT_THAT([&] { write_exr(at("b.exr"), ramp(400, 400)); },
                    ThrowsMessage<Error>(HasSubstr("b.exr")));
    }
    EXPECT_THAT(entries(), ElementsAre("a.png"));
    EXPECT_EQ(read_png(at("a.png")).width, 4);
}

TEST_F(PictureFile, VideoOnAFullDiskIsAnErrorAndLeavesNothing)
{
    const auto encode = [&]
    {
        const FileSizeLimit limit(4096);
        const auto writer = make_frame_writer(at("a.mp4").string(), 128, 96, 30);
        for (int i = 0; i < 30; ++i) writer->add(noise8(128, 96));
        writer->finish();
    };
    EXPECT_THAT(encode, ThrowsMessage<Error>(AllOf(HasSubstr("a.mp4"), HasSubstr("ffmpeg"))));
    EXPECT_THAT(entries(), IsEmpty());
}

TEST_F(PictureFile, BrokenFilesAreErrors)
{
    write_png(at("a.png"), noise8(40, 40));
    write_exr(at("a.exr"), ramp(40, 40));
    for (const double share : {0.0, 0.01, 0.5, 0.9})
    {
        for (const char* name : {"a.png", "a.exr"})
        {
            std::filesystem::copy_file(at(name), at("cut"),
                                       std::filesystem::copy_options::overwrite_existing);
            std::filesystem::resize_file(
                at("cut"), static_cast<std::uintmax_t>(
                               share * static_cast<double>(std::filesystem::file_size(at(name)))));
            if (std::string(name) == "a.png")
                EXPECT_THAT([&] { read_png(at("cut")); }, ThrowsMessage<Error>(HasSubstr("cut"))) << share;
            else
                EXPECT_THAT([&] { read_exr(at("cut")); }, ThrowsMessage<Error>(HasSubstr("cut"))) << share;
        }
    }
    EXPECT_THAT([&] { read_png(at("none.png")); }, ThrowsMessage<Error>(HasSubstr("No such file")));
    EXPECT_THAT([&] { read_exr(at(".")); }, ThrowsMessage<Error>(HasSubstr("directory")));
    EXPECT_THAT([&] { read_exr(at("a.png")); }, ThrowsMessage<Error>(HasSubstr("a.png")));
    EXPECT_THAT([&] { write_png(at("b.png"), Image8{}); }, ThrowsMessage<Error>(HasSubstr("empty")));
}

TEST(Srgb, KnownValues)
{
    // IEC 61966-2-1: the two pieces, their joint, and mid grey.
    EXPECT_EQ(srgb_encode(0.0F), 0.0F);
    EXPECT_EQ(srgb_encode(1.0F), 1.0F);
    EXPECT_NEAR(srgb_encode(0.0031308F), 0.04045, 2e-6);
    EXPECT_NEAR(srgb_encode(0.001F), 0.01292, 1e-8);
    EXPECT_NEAR(srgb_encode(0.18F), 0.461356, 1e-6);
    EXPECT_NEAR(srgb_encode(0.5F), 0.735357, 1e-6);
    EXPECT_EQ(srgb_encode(-1.0F), 0.0F);
    EXPECT_EQ(srgb_encode(7.0F), 1.0F);
    EXPECT_EQ(srgb_encode(std::numeric_limits<float>::quiet_NaN()), 0.0F);
}

TEST(Srgb, EveryLevelComesBackFromItsLinearValue)
{
    Image linear(256, 1);
    for (int i = 0; i < 256; ++i)
    {
        const double v = i / 255.0;
        linear.pixel(i, 0)[1] =
            static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    const Image8 display = to_srgb8(linear);
    for (int i = 0; i < 256; ++i)
    {
        EXPECT_EQ(display.rgb[static_cast<std::size_t>(i) * 3 + 1], i);
        EXPECT_EQ(display.rgb[static_cast<std::size_t>(i) * 3], 0);
    }
}

}  // namespace
}  // namespace spindrift::image
