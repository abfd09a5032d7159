// SPDX-License-Identifier: MIT
// The bright part of the picture: pixel by pixel, or with HALF the mean of two by two. Where there is any, the draw
// calls of the chain that follows are armed; if there is none, they draw nothing.
#include "bright.glsl"
layout(binding = 0) uniform sampler2D linear_picture;
layout(std430, binding = 6) buffer Command { uint vertices; };
layout(location = 0) out vec4 colour;

vec3 bright_at(ivec2 p, ivec2 size)
{
    return bright_part(exposure.x * contained(texelFetch(linear_picture, min(p, size - 1), 0).rgb));
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    ivec2 size = textureSize(linear_picture, 0);
#ifdef HALF
    p *= 2;
    bvec2 whole = lessThan(p + 1, size);
    vec3 sum = bright_at(p, size);
    if (whole.x) sum += bright_at(p + ivec2(1, 0), size);
    if (whole.y) sum += bright_at(p + ivec2(0, 1), size);
    if (whole.x && whole.y) sum += bright_at(p + ivec2(1, 1), size);
    sum *= 0.25;
#else
    vec3 sum = bright_at(p, size);
#endif
    if (any(greaterThan(sum, vec3(0.0))) && vertices == 0u) vertices = 3u;
    colour = vec4(sum, 1.0);
}
