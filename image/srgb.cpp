// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "image/write.h"

namespace spindrift::image
{

float srgb_encode(float linear)
{
    if (!(linear > 0.0F)) return 0.0F;  // NaN too
    if (linear >= 1.0F) return 1.0F;
    const double x = linear;
    return static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

Image8 to_srgb8(const Image& display_linear)
{
    Image8 out{display_linear.width, display_linear.height, {}};
    const std::size_t pixels = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
    out.rgb.resize(pixels * 3);
    for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            out.rgb[i * 3 + c] =
                static_cast<unsigned char>(std::lround(srgb_encode(display_linear.rgba[i * 4 + c]) * 255.0F));
    return out;
}

Image8 side_by_side(const Image8& left, const Image8& right)
{
    Image8 out{left.width + right.width, left.height, {}};
    out.rgb.reserve(left.rgb.size() + right.rgb.size());
    for (int y = 0; y < left.height; ++y)
        for (const Image8* part : {&left, &right})
        {
            const auto row = part->rgb.begin() + static_cast<std::ptrdiff_t>(y) * part->width * 3;
            out.rgb.insert(out.rgb.end(), row, row + static_cast<std::ptrdiff_t>(part->width) * 3);
        }
    return out;
}

}  // namespace spindrift::image
