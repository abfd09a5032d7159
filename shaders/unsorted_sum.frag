// SPDX-License-Identifier: MIT
// Adds up the samples of a pixel, each a share of it.
layout(binding = 0) uniform sampler2DMS flakes;
layout(location = 0) uniform ivec2 samples;  // of this pass, in all
layout(location = 0) out vec4 colour;

void main()
{
    vec4 sum = vec4(0.0);
    for (int s = 0; s < samples.x; ++s) sum += texelFetch(flakes, ivec2(gl_FragCoord.xy), s);
    colour = sum / float(samples.y);
}
