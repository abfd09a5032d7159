// SPDX-License-Identifier: MIT
// One fragment: the mean over all blocks, and a step towards the exposure that it asks for (core/exposure.h).
layout(binding = 0) uniform sampler2D blocks;
layout(location = 0) uniform vec2 log_grey_and_share;
layout(std430, binding = 7) buffer Exposure { vec4 exposure; };

void main()
{
    ivec2 size = textureSize(blocks, 0);
    vec2 sum = vec2(0.0);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) sum += texelFetch(blocks, ivec2(x, y), 0).rg;
    float mean = sum.x / sum.y;
    float wanted = log_grey_and_share.x - mean;
    float now = mix(exposure.y, wanted, log_grey_and_share.y);
    exposure = vec4(exp2(now), now, mean, 0.0);
}
