// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <png.h>

#include "core/error.h"
#include "image/whole_file.h"
#include "image/write.h"

namespace spindrift::image
{

namespace
{

/// libpng's simplified interface: 8 bit RGB, sRGB, errors as values.
struct Png
{
    png_image image{};
    Png()
    {
        image.version = PNG_IMAGE_VERSION;
        image.format = PNG_FORMAT_RGB;
    }
    ~Png() { png_image_free(&image); }
    Png(const Png&) = delete;
    Png& operator=(const Png&) = delete;
};

[[noreturn]] void fail(const char* verb, const std::filesystem::path& file, const char* why)
{
    throw Error(fmt::format("{}: cannot {} as PNG: {}", file.string(), verb, why));
}

}  // namespace

void write_png(const std::filesystem::path& file, const Image8& image)
{
    const std::size_t need =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3;
    if (image.width <= 0 || image.height <= 0 || image.rgb.size() != need)
        fail("write", file, "the picture is empty or its size does not fit its data");
    Png png;
    png.image.width = static_cast<png_uint_32>(image.width);
    png.image.height = static_cast<png_uint_32>(image.height);
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.image);
    std::vector<std::byte> bytes(size);
    if (png_image_write_to_memory(&png.image, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0)
        fail("write", file, png.image.message);
    write_whole(file, std::span(bytes).first(size));
}

Image8 read_png(const std::filesystem::path& file)
{
    const std::vector<std::byte> bytes = read_whole(file);
    Png png;
    if (png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size()) == 0)
        fail("read", file, png.image.message);
    constexpr std::uint64_t kMaxPixels = 1ULL << 28U;
    if (std::uint64_t{png.image.width} * png.image.height > kMaxPixels)
        fail("read", file, "it has more than 2^28 pixels");
    png.image.format = PNG_FORMAT_RGB;
    png.image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    Image8 out{static_cast<int>(png.image.width), static_cast<int>(png.image.height), {}};
    out.rgb.resize(PNG_IMAGE_SIZE(png.image));
    const png_color black{};
    if (png_image_finish_read(&png.image, &black, out.rgb.data(), 0, nullptr) == 0)
        fail("read", file, png.image.message);
    return out;
}

}  // namespace spindrift::image
