// SPDX-License-Identifier: MIT
// Sum of the log2 luminances of every fourth pixel each way in a block of 32 x 32, and their number (core/exposure.h).
#include "contained.glsl"
layout(binding = 0) uniform sampler2D linear_picture;
layout(location = 0) out vec2 sum_and_count;

const int kStride = 4;
const int kBlock = 32;
const float kDarkest = 1e-4;

void main()
{
    ivec2 size = textureSize(linear_picture, 0);
    ivec2 corner = ivec2(gl_FragCoord.xy) * kBlock;
    vec2 sum = vec2(0.0);
    for (int y = corner.y; y < min(corner.y + kBlock, size.y); y += kStride)
        for (int x = corner.x; x < min(corner.x + kBlock, size.x); x += kStride)
        {
            vec3 c = contained(texelFetch(linear_picture, min(ivec2(x, y) + kStride / 2, size - 1), 0).rgb);
            sum += vec2(log2(dot(c, vec3(0.2126, 0.7152, 0.0722)) + kDarkest), 1.0);
        }
    sum_and_count = sum;
}
