// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace spindrift::image
{

/// Linear scene-referred RGBA in float, rows from the top, 4 floats a pixel; alpha is coverage.
struct Image
{
    int width = 0, height = 0;
    std::vector<float> rgba;

    Image() = default;
    Image(int width_px, int height_px)
        : width(width_px),
          height(height_px),
          rgba(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 4)
    {
    }
    float* pixel(int x, int y)
    {
        return &rgba[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)) *
                     4];
    }
    const float* pixel(int x, int y) const
    {
        return &rgba[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)) *
                     4];
    }
};

/// Display-referred sRGB, 8 bit RGB, rows from the top.
struct Image8
{
    int width = 0, height = 0;
    std::vector<unsigned char> rgb;
};

}  // namespace spindrift::image
