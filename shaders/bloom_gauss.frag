// SPDX-License-Identifier: MIT
// One axis of a separable blur; outside of the picture there is no light. The weights follow from each other: that of tap
// i + 1 is that of tap i times ratio, and ratio falls by the factor `bend` from tap to tap (Gaussian), or all are one (box).
layout(binding = 0) uniform sampler2D from;
layout(location = 0) uniform vec3 weight_ratio_bend;
layout(location = 1) uniform int radius;
layout(location = 0) out vec4 colour;

#ifdef ALONG_Y
#define AXIS y
const ivec2 kStep = ivec2(0, 1);
#else
#define AXIS x
const ivec2 kStep = ivec2(1, 0);
#endif

vec3 side(ivec2 p, ivec2 way, int taps)
{
    vec3 sum = vec3(0.0);
    float ratio = weight_ratio_bend.y;
    float weight = weight_ratio_bend.x * ratio;
    for (int i = 0; i < taps; ++i)
    {
        p += way;
        sum += weight * texelFetch(from, p, 0).rgb;
        ratio *= weight_ratio_bend.z;
        weight *= ratio;
    }
    return sum;
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 sum = weight_ratio_bend.x * texelFetch(from, p, 0).rgb;
    sum += side(p, -kStep, min(radius, p.AXIS));
    sum += side(p, kStep, min(radius, textureSize(from, 0).AXIS - 1 - p.AXIS));
    colour = vec4(sum, 1.0);
}
