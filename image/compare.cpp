// SPDX-License-Identifier: MIT
#include "image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace spindrift::image
{

namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Gathers the figures channel by channel; a NaN on either side counts as an infinite difference.
class Gatherer
{
  public:
    explicit Gatherer(double tolerance) : tolerance_(tolerance) {}

    /// `a`, `b`: linear light; `off`: what the tolerance is about.
    void channel(double a, double b, double off)
    {
        if (std::isnan(off) || std::isnan(a) || std::isnan(b)) off = kInfinity;
        const double linear = std::isinf(off) ? kInfinity : a - b;
        pixel_squares_ += linear * linear;
        norm_ += std::isnan(b) ? 0 : b * b;
        worst_ = std::max(worst_, off);
        pixel_worst_ = std::max(pixel_worst_, off);
    }

    void end_pixel()
    {
        const bool above = pixel_worst_ > tolerance_;
        squares_ += pixel_squares_;
        rest_squares_ += above ? 0 : pixel_squares_;
        above_ += above ? 1 : 0;
        pixel_squares_ = 0;
        pixel_worst_ = 0;
        ++pixels_;
    }

    Difference result() const
    {
        Difference out;
        out.worst = worst_;
        out.share_above = pixels_ > 0 ? above_ / pixels_ : 0;
        out.relative_l2 = relative(squares_);
        out.rest_relative_l2 = relative(rest_squares_);
        return out;
    }

  private:
    double relative(double squares) const
    {
        if (squares == 0) return 0;
        return norm_ > 0 ? std::sqrt(squares / norm_) : kInfinity;
    }

    double tolerance_;
    double pixel_squares_ = 0, rest_squares_ = 0;
    double squares_ = 0, norm_ = 0, worst_ = 0, pixel_worst_ = 0, above_ = 0, pixels_ = 0;
};

std::array<double, 256> srgb_levels()
{
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i)
    {
        const double v = static_cast<double>(i) / 255.0;
        linear[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    }
    return linear;
}

}  // namespace

void require_same_size(int width_a, int height_a, int width_b, int height_b)
{
    if (width_a != width_b || height_a != height_b)
        throw Error(fmt::format("cannot compare pictures of {}x{} and {}x{} pixels; give two of one size",
                                width_a, height_a, width_b, height_b));
}

Difference compare(const Image& a, const Image& b, double tolerance)
{
    require_same_size(a.width, a.height, b.width, b.height);
    Gatherer gather(tolerance);
    for (std::size_t i = 0; i < a.rgba.size(); i += 4)
    {
        for (std::size_t c = i; c < i + 3; ++c)
        {
            const double x = a.rgba[c], y = b.rgba[c];
            gather.channel(x, y, x == y ? 0.0 : std::abs(x - y));
        }
        gather.end_pixel();
    }
    return gather.result();
}

Difference compare(const Image8& a, const Image8& b, int tolerance_levels)
{
    require_same_size(a.width, a.height, b.width, b.height);
    static const std::array<double, 256> linear = srgb_levels();
    Gatherer gather(tolerance_levels);
    for (std::size_t i = 0; i < a.rgb.size(); i += 3)
    {
        for (std::size_t c = i; c < i + 3; ++c)
            gather.channel(linear[a.rgb[c]], linear[b.rgb[c]], std::abs(int{a.rgb[c]} - int{b.rgb[c]}));
        gather.end_pixel();
    }
    return gather.result();
}

}  // namespace spindrift::image
