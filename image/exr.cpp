// SPDX-License-Identifier: MIT
#include <ImfIO.h>
#include <ImfRgbaFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "image/whole_file.h"
#include "image/write.h"

namespace spindrift::image
{

namespace
{

class ByteSink final : public Imf::OStream
{
  public:
    ByteSink() : OStream("memory") {}
    void write(const char bytes[], int count) override
    {
        const std::size_t end = position_ + static_cast<std::size_t>(count);
        if (bytes_.size() < end) bytes_.resize(end);
        std::memcpy(bytes_.data() + position_, bytes, static_cast<std::size_t>(count));
        position_ = end;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }
    const std::vector<std::byte>& bytes() const { return bytes_; }

  private:
    std::vector<std::byte> bytes_;
    std::size_t position_ = 0;
};

class ByteSource final : public Imf::IStream
{
  public:
    explicit ByteSource(const std::vector<std::byte>& bytes) : IStream("memory"), bytes_(bytes) {}
    bool read(char to[], int count) override
    {
        const auto size = static_cast<std::size_t>(count);
        if (position_ > bytes_.size() || bytes_.size() - position_ < size)
            throw Error("the file is cut short");
        std::memcpy(to, bytes_.data() + position_, size);
        position_ += size;
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

  private:
    const std::vector<std::byte>& bytes_;
    std::size_t position_ = 0;
};

/// Half floats end at 65504; a brighter lamp stays the brightest thing, not infinity.
half to_half(float value)
{
    return half(std::clamp(value, -65504.0F, 65504.0F));
}

[[noreturn]] void fail(const char* verb, const std::filesystem::path& file, const char* why)
{
    throw Error(fmt::format("{}: cannot {} as OpenEXR: {}", file.string(), verb, why));
}

Image decode(const std::vector<std::byte>& bytes)
{
    ByteSource source(bytes);
    Imf::RgbaInputFile in(source);
    const Imath::Box2i window = in.dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1,
                       height = std::int64_t{window.max.y} - window.min.y + 1;
    constexpr std::int64_t kMaxPixels = 1LL << 28;
    if (width <= 0 || height <= 0 || width > kMaxPixels || height > kMaxPixels || width * height > kMaxPixels)
        throw Error("its data window is empty or has more than 2^28 pixels");
    std::vector<Imf::Rgba> pixels(static_cast<std::size_t>(width * height));
    in.setFrameBuffer(pixels.data() - window.min.x - window.min.y * width, 1,
                      static_cast<std::size_t>(width));
    in.readPixels(window.min.y, window.max.y);
    Image out(static_cast<int>(width), static_cast<int>(height));
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
        const Imf::Rgba& p = pixels[i];
        const float rgba[4] = {p.r, p.g, p.b, p.a};
        std::copy_n(rgba, 4, &out.rgba[i * 4]);
    }
    return out;
}

}  // namespace

void write_exr(const std::filesystem::path& file, const Image& image)
{
    const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (image.width <= 0 || image.height <= 0 || image.rgba.size() != count * 4)
        fail("write", file, "the picture is empty or its size does not fit its data");
    std::vector<Imf::Rgba> pixels(count);
    for (std::size_t i = 0; i < count; ++i)
    {
        const float* p = &image.rgba[i * 4];
        pixels[i] = Imf::Rgba(to_half(p[0]), to_half(p[1]), to_half(p[2]), to_half(p[3]));
    }
    ByteSink sink;
    try
    {
        Imf::Header header(image.width, image.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        Imf::RgbaOutputFile out(sink, header, Imf::WRITE_RGBA);
        out.setFrameBuffer(pixels.data(), 1, static_cast<std::size_t>(image.width));
        out.writePixels(image.height);
    }
    catch (const std::exception& error)
    {
        fail("write", file, error.what());
    }
    write_whole(file, sink.bytes());
}

Image read_exr(const std::filesystem::path& file)
{
    const std::vector<std::byte> bytes = read_whole(file);
    try
    {
        return decode(bytes);
    }
    catch (const std::exception& error)
    {
        fail("read", file, error.what());
    }
}

}  // namespace spindrift::image
