// SPDX-License-Identifier: MIT
// From light to what a display shows: exposure, bloom, tone curve, sRGB, dither.
#define VARYING in
#include "develop_constants.glsl"
#include "contained.glsl"
#include "bright_part.glsl"
#include "tone_curves.glsl"
layout(binding = 0) uniform sampler2D linear_picture;
layout(binding = 1) uniform sampler2D spread;
layout(location = 0) out vec4 colour;

// IEC 61966-2-1. Its power of 1 / 2.4 is that of 5 / 3 of the fourth root, and a polynomial there (Chebyshev fit) is within
// 8e-6 of it, 0.002 of a level: two roots instead of a logarithm and an exponential.
vec3 srgb(vec3 c)
{
    vec3 t = sqrt(sqrt(c));
    vec3 curve = -0.0614833354 + t * (0.1634954932 + t * (1.2497799741 + t * (-0.5673877389 + t * (0.2809710547 - 0.0653806371 * t))));
    return mix(curve, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

// Within half a step of 8 bits either way. Source: J. Jimenez, SIGGRAPH 2014 (interleaved gradient noise).
float noise(vec2 p)
{
    return (fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))) - 0.5) / 255.0;
}

void main()
{
    vec3 given = texelFetch(linear_picture, ivec2(gl_FragCoord.xy), 0).rgb;
    vec3 c = exposure * contained(given);
#ifdef BLOOM
    if (mixing.x > 0.0)
    {
        vec3 moved = texture(spread, gl_FragCoord.xy * mixing.yz).rgb;
        if (sets_in(given)) moved -= bright_part(c);
        c = max(c + mixing.x * moved, 0.0);
    }
#endif
    c = srgb(tone_mapped(c));
#ifdef DITHER
    c += noise(gl_FragCoord.xy);
#endif
    colour = vec4(c, 1.0);
}
