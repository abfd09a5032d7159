// SPDX-License-Identifier: MIT
// From light to what a display shows: exposure, bloom, tone curve, sRGB (IEC 61966-2-1), dither.
#include "bright.glsl"
#include "tone_curves.glsl"
layout(binding = 0) uniform sampler2D linear_picture;
#ifdef BLOOM
layout(binding = 1) uniform sampler2D spread;
layout(std140, binding = 3) uniform Command { uvec4 command; };  // no vertices: the chain found nothing bright
layout(location = 2) uniform vec3 mixing;                        // weight; from pixels to coordinates of spread
#endif
layout(location = 0) out vec4 colour;

vec3 srgb(vec3 c)
{
    vec3 curve = 1.055 * pow(max(c, 1e-10), vec3(1.0 / 2.4)) - 0.055;
    return mix(curve, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

// Within half a step of 8 bits either way. Source: J. Jimenez, SIGGRAPH 2014 (interleaved gradient noise).
float noise(vec2 p)
{
    return (fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))) - 0.5) / 255.0;
}

void main()
{
    vec3 c = exposure.x * contained(texelFetch(linear_picture, ivec2(gl_FragCoord.xy), 0).rgb);
#ifdef BLOOM
    if (command.x != 0u) c += mixing.x * (texture(spread, gl_FragCoord.xy * mixing.yz).rgb - bright_part(c));
#endif
    c = srgb(tone_mapped(max(c, 0.0)));
#ifdef DITHER
    c += noise(gl_FragCoord.xy);
#endif
    colour = vec4(c, 1.0);
}
