// SPDX-License-Identifier: MIT
// The bright part of the picture: pixel by pixel, or with HALF the mean of two by two. Where there is any, the draw
// calls of the chain that follows are armed; if there is none, they draw nothing.
#define VARYING in
#include "develop_constants.glsl"
#include "contained.glsl"
#include "bright_part.glsl"
layout(binding = 0) uniform sampler2D linear_picture;
layout(std430, binding = 6) buffer Command { uint vertices; };
layout(location = 0) out vec4 colour;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
#ifdef HALF
    // Outside of the picture there is no light.
    p *= 2;
    bvec2 inside = lessThan(p + 1, textureSize(linear_picture, 0));
    vec3 c[4];
    c[0] = texelFetch(linear_picture, p, 0).rgb;
    c[1] = inside.x ? texelFetch(linear_picture, p + ivec2(1, 0), 0).rgb : vec3(0.0);
    c[2] = inside.y ? texelFetch(linear_picture, p + ivec2(0, 1), 0).rgb : vec3(0.0);
    c[3] = inside.x && inside.y ? texelFetch(linear_picture, p + ivec2(1, 1), 0).rgb : vec3(0.0);
    vec3 sum = vec3(0.0);
    if (sets_in(c[0]) || sets_in(c[1]) || sets_in(c[2]) || sets_in(c[3]))
        for (int i = 0; i < 4; ++i) sum += 0.25 * bright_part(exposure * contained(c[i]));
#else
    vec3 sum = bright_part(exposure * contained(texelFetch(linear_picture, p, 0).rgb));
#endif
    if (any(greaterThan(sum, vec3(0.0))) && vertices == 0u) vertices = 3u;
    colour = vec4(sum, 1.0);
}
