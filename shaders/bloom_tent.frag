// SPDX-License-Identifier: MIT
// One axis of a tent that takes every FACTOR texels to one: it keeps the centre of light, as a box would not.
layout(binding = 0) uniform sampler2D from;
layout(location = 0) out vec4 colour;

#ifdef ALONG_Y
#define AXIS y
const ivec2 kStep = ivec2(0, 1);
const ivec2 kScale = ivec2(1, FACTOR);
#else
#define AXIS x
const ivec2 kStep = ivec2(1, 0);
const ivec2 kScale = ivec2(FACTOR, 1);
#endif

void main()
{
    // Taps at -FACTOR + 1/2 ... FACTOR - 1/2 from the middle of the texel.
    ivec2 middle = ivec2(gl_FragCoord.xy) * kScale + kStep * (FACTOR / 2);
    int last = textureSize(from, 0).AXIS - 1;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < FACTOR; ++i)
    {
        float weight = (float(FACTOR - i) - 0.5) / float(FACTOR * FACTOR);
        ivec2 above = middle + i * kStep;
        ivec2 below = middle - (i + 1) * kStep;
        if (above.AXIS <= last) sum += weight * texelFetch(from, above, 0).rgb;
        if (below.AXIS >= 0 && below.AXIS <= last) sum += weight * texelFetch(from, below, 0).rgb;
    }
    colour = vec4(sum, 1.0);
}
