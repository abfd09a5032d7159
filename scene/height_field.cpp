// SPDX-License-Identifier: MIT
#include "scene/height_field.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "core/error.h"

namespace spindrift::scene
{

namespace
{

constexpr unsigned kLargestSide_px = 8192;
constexpr int kMostVerticesPerSide = 1025;

struct Grey16
{
    unsigned width = 0, height = 0;
    std::vector<std::uint16_t> rows;  ///< from the top; 8-bit values are spread to 16 bits
};

struct CloseFile
{
    void operator()(std::FILE* file) const { std::fclose(file); }
};

/// libpng's complaints land here; longjmp is its own way out.
struct Complaint
{
    char text[128] = "broken";
};

[[noreturn]] void complain(png_structp png, png_const_charp text)
{
    auto* complaint = static_cast<Complaint*>(png_get_error_ptr(png));
    std::snprintf(complaint->text, sizeof complaint->text, "%s", text);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

enum class ReadResult
{
    done,
    broken,
    coloured,
    too_large,
};

/// Decodes into `out`; nothing here owns memory when libpng jumps.
ReadResult decode(png_structp png, png_infop info, std::FILE* file, Grey16& out)
{
    if (setjmp(png_jmpbuf(png)) != 0) return ReadResult::broken;
    png_init_io(png, file);
    png_set_user_limits(png, kLargestSide_px, kLargestSide_px);
    png_read_info(png, info);
    if ((png_get_color_type(png, info) & (PNG_COLOR_MASK_COLOR | PNG_COLOR_MASK_PALETTE)) != 0)
        return ReadResult::coloured;
    out.width = png_get_image_width(png, info);
    out.height = png_get_image_height(png, info);
    png_set_expand_gray_1_2_4_to_8(png);
    png_set_expand_16(png);
    png_set_strip_alpha(png);
    png_set_swap(png);  // PNG is big-endian
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    if (png_get_rowbytes(png, info) != std::size_t{2} * out.width) return ReadResult::broken;
    out.rows.resize(std::size_t{out.width} * out.height);
    const int passes = png_get_interlace_type(png, info) == PNG_INTERLACE_ADAM7 ? 7 : 1;
    for (int pass = 0; pass < passes; ++pass)
        for (unsigned y = 0; y < out.height; ++y)
            png_read_row(png, reinterpret_cast<png_bytep>(out.rows.data() + std::size_t{y} * out.width),
                         nullptr);
    png_read_end(png, nullptr);
    return ReadResult::done;
}

Grey16 read_grey(const std::filesystem::path& path)
{
    std::error_code failed;
    if (!std::filesystem::is_regular_file(path, failed))
        throw Error(fmt::format("{}: no such height field (a grey PNG of 8 or 16 bit)", path.string()));
    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
    if (!file) throw Error(fmt::format("{} cannot be opened for reading", path.string()));
    Complaint complaint;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &complaint, complain, ignore_warning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    if (info == nullptr)
    {
        png_destroy_read_struct(&png, nullptr, nullptr);
        throw Error("libpng has no memory left");
    }
    Grey16 grey;
    const ReadResult result = decode(png, info, file.get(), grey);
    png_destroy_read_struct(&png, &info, nullptr);
    if (result == ReadResult::coloured)
        throw Error(fmt::format("{} is a coloured picture; a height field is a grey PNG of 8 or 16 bit",
                                path.string()));
    if (result != ReadResult::done)
        throw Error(fmt::format("{} cannot be read as a height field: {}", path.string(), complaint.text));
    if (grey.width < 2 || grey.height < 2)
        throw Error(fmt::format("{} has {} x {} pixels; a height field needs at least 2 x 2", path.string(),
                                grey.width, grey.height));
    return grey;
}

}  // namespace

HeightField::HeightField(const GroundSettings& ground, const DomainSettings& domain,
                         const std::filesystem::path& folder)
    : datum_m_(ground.height_m - domain.min_m.z),
      relief_m_(ground.relief_m),
      size_x_m_(domain.max_m.x - domain.min_m.x),
      size_y_m_(domain.max_m.y - domain.min_m.y),
      surface_(ground.surface),
      albedo_(ground.albedo)
{
    const Grey16 grey = read_grey(ground.file.is_absolute() ? ground.file : folder / ground.file);
    width_ = static_cast<int>(grey.width);
    height_ = static_cast<int>(grey.height);
    grey_.resize(grey.rows.size());
    for (unsigned y = 0; y < grey.height; ++y)
        std::copy_n(&grey.rows[std::size_t{y} * grey.width], grey.width,
                    &grey_[std::size_t{grey.height - 1 - y} * grey.width]);
}

double HeightField::value(int column, int row) const
{
    return grey_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(column)];
}

double HeightField::height_m(double x_m, double y_m) const
{
    const double u = std::clamp(x_m / size_x_m_, 0.0, 1.0) * (width_ - 1);
    const double v = std::clamp(y_m / size_y_m_, 0.0, 1.0) * (height_ - 1);
    const int i = std::min(static_cast<int>(u), width_ - 2), j = std::min(static_cast<int>(v), height_ - 2);
    const double fu = u - i, fv = v - j;
    const double south = value(i, j) * (1 - fu) + value(i + 1, j) * fu;
    const double north = value(i, j + 1) * (1 - fu) + value(i + 1, j + 1) * fu;
    return datum_m_ + relief_m_ * (south * (1 - fv) + north * fv) / 65535.0;
}

Mesh HeightField::mesh() const
{
    const int nx = std::min(width_, kMostVerticesPerSide), ny = std::min(height_, kMostVerticesPerSide);
    const double dx = size_x_m_ / (nx - 1), dy = size_y_m_ / (ny - 1);
    Mesh mesh;
    mesh.surface = surface_;
    mesh.solid = false;  // its columns are filled from the heights themselves
    mesh.materials.push_back({.albedo = albedo_});
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
        {
            const double x = i * dx, y = j * dy;
            const double sx =
                (height_m(x + dx, y) - height_m(x - dx, y)) / (i == 0 || i == nx - 1 ? dx : 2 * dx);
            const double sy =
                (height_m(x, y + dy) - height_m(x, y - dy)) / (j == 0 || j == ny - 1 ? dy : 2 * dy);
            const double length = std::sqrt(sx * sx + sy * sy + 1);
            mesh.vertices.push_back(
                {{static_cast<float>(x), static_cast<float>(y), static_cast<float>(height_m(x, y))},
                 {static_cast<float>(-sx / length), static_cast<float>(-sy / length),
                  static_cast<float>(1 / length)}});
        }
    MeshPart& part = mesh.parts.emplace_back();
    for (int j = 0; j + 1 < ny; ++j)
        for (int i = 0; i + 1 < nx; ++i)
        {
            const auto a = static_cast<std::uint32_t>(j * nx + i), b = a + 1;
            const std::uint32_t c = a + static_cast<std::uint32_t>(nx), d = c + 1;
            part.indices.insert(part.indices.end(), {a, b, d, a, d, c});
        }
    return mesh;
}

}  // namespace spindrift::scene
