// SPDX-License-Identifier: MIT
// Exposure, clamp, sRGB (IEC 61966-2-1).
#include "frame.glsl"
layout(binding = 0) uniform sampler2D linear_picture;
layout(location = 0) out vec4 colour;

void main()
{
    vec3 c = clamp(zenith_exposure.w * texelFetch(linear_picture, ivec2(gl_FragCoord.xy), 0).rgb, 0.0, 1.0);
    vec3 curve = 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055;
    colour = vec4(mix(curve, 12.92 * c, lessThanEqual(c, vec3(0.0031308))), 1.0);
}
