// SPDX-License-Identifier: MIT
// Exposure and clamp; the target encodes to sRGB (IEC 61966-2-1) as it stores.
#include "frame.glsl"
layout(binding = 0) uniform sampler2D linear_picture;
layout(location = 0) out vec4 colour;

void main()
{
    vec3 c = clamp(zenith_exposure.w * texelFetch(linear_picture, ivec2(gl_FragCoord.xy), 0).rgb, 0.0, 1.0);
    colour = vec4(c, 1.0);
}
