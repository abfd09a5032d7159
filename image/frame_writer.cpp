// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "core/error.h"
#include "image/video.h"
#include "image/whole_file.h"
#include "image/write.h"

namespace spindrift::image
{

namespace
{

/// A file name with the place of one frame number in it.
struct NumberedName
{
    std::string before, after;
    int width = 0;
    bool zeros = false;

    std::string operator()(std::uint64_t number) const
    {
        return before + (zeros ? fmt::format("{:0{}}", number, width) : fmt::format("{:{}}", number, width)) +
               after;
    }
};

[[noreturn]] void bad_number(const std::string& pattern)
{
    throw Error(
        fmt::format("{}: '%' must start one frame number like %d or %04d; write it once, or leave '%' out "
                    "for a single picture",
                    pattern));
}

/// Nothing if the pattern has no frame number. Only %d, %Nd and %0Nd with N of 1 to 9 are frame numbers.
std::optional<NumberedName> parse_number(const std::string& pattern)
{
    const std::size_t start = pattern.find('%');
    if (start == std::string::npos) return std::nullopt;
    if (pattern.find('%', start + 1) != std::string::npos) bad_number(pattern);
    NumberedName name;
    name.before = pattern.substr(0, start);
    std::size_t at = start + 1;
    const auto is = [&](auto test)
    { return at < pattern.size() && test(static_cast<unsigned char>(pattern[at])); };
    if (is([](unsigned char c) { return c == '0'; })) name.zeros = true, ++at;
    if (is([](unsigned char c) { return c >= '1' && c <= '9'; })) name.width = pattern[at++] - '0';
    if (!is([](unsigned char c) { return c == 'd'; }) || (name.zeros && name.width == 0)) bad_number(pattern);
    name.after = pattern.substr(at + 1);
    return name;
}

void write_picture(const std::filesystem::path& file, const Image8& picture)
{
    write_png(file, picture);
}

void write_picture(const std::filesystem::path& file, const Image& picture)
{
    write_exr(file, picture);
}

/// Files of one kind of picture. Given a frame number in the name each frame becomes a file at once, from
/// number 0; without one the last frame becomes the file in finish().
template <class Picture>
class PictureWriter final : public FrameWriter
{
  public:
    PictureWriter(std::string pattern, int width, int height)
        : pattern_(std::move(pattern)), name_(parse_number(pattern_)), width_(width), height_(height)
    {
        const AsideFile probe(name_ ? (*name_)(0)
                                    : pattern_);  // an unwritable place shows before the run, not after it
    }

    bool wants_linear() const override { return std::is_same_v<Picture, Image>; }
    bool keeps_last_only() const override { return !name_; }
    void add(const Image& linear) override { take(linear); }
    void add(const Image8& display) override { take(display); }

    void finish() override
    {
        if (last_) write_picture(pattern_, *last_);
        last_.reset();
    }

  private:
    void take(const Picture& picture)
    {
        if (picture.width != width_ || picture.height != height_)
            throw Error(fmt::format("{}: a frame of {}x{} pixels does not fit pictures of {}x{}", pattern_,
                                    picture.width, picture.height, width_, height_));
        if (name_)
            write_picture((*name_)(frames_++), picture);
        else
            last_ = picture;
    }

    template <class Other>
    void take(const Other&)
    {
        throw std::logic_error(wants_linear() ? "an EXR takes linear pictures"
                                              : "a PNG takes display pictures");
    }

    std::string pattern_;
    std::optional<NumberedName> name_;
    int width_, height_;
    std::optional<Picture> last_;
    std::uint64_t frames_ = 0;
};

std::string extension_of(const std::string& pattern)
{
    std::string extension = std::filesystem::path(pattern).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

}  // namespace

std::unique_ptr<FrameWriter> make_frame_writer(const std::string& pattern, int width, int height,
                                               double frames_per_s)
{
    constexpr int kMostPixels = 32768;
    if (width <= 0 || height <= 0 || width > kMostPixels || height > kMostPixels)
        throw Error(fmt::format("{}: {}x{} pixels cannot be written; give a width and a height of 1 to {}",
                                pattern, width, height, kMostPixels));
    if (!std::isfinite(frames_per_s) || frames_per_s <= 0)
        throw Error(fmt::format("{}: {} frames per second cannot be written; give a rate above 0", pattern,
                                frames_per_s));
    const std::string extension = extension_of(pattern);
    if (extension == ".png") return std::make_unique<PictureWriter<Image8>>(pattern, width, height);
    if (extension == ".exr") return std::make_unique<PictureWriter<Image>>(pattern, width, height);
    if (extension != ".mp4")
        throw Error(
            fmt::format("{}: cannot tell the kind of picture from '{}'; end the name in .png, .exr or .mp4",
                        pattern, extension));
    if (pattern.find('%') != std::string::npos)
        throw Error(fmt::format("{}: a video is one file and takes no frame number; leave '%' out", pattern));
    return make_video_writer(pattern, width, height, frames_per_s);
}

}  // namespace spindrift::image
