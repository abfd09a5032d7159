// SPDX-License-Identifier: MIT
// Exposed light and what of it is bright, as core/bloom.h has it.
layout(std140, binding = 2) uniform Exposure { vec4 exposure; };  // factor; its log2; log2 of the mean luminance; 0
layout(location = 0) uniform vec3 bright;                         // threshold, width of the knee, ceiling

// NaN compares false.
vec3 contained(vec3 c)
{
    return mix(vec3(0.0), min(c, vec3(65504.0)), greaterThan(c, vec3(0.0)));
}

vec3 bright_part(vec3 c)
{
    float given = max(c.x, max(c.y, c.z));
    float value = min(given, bright.z);
    float soft = clamp(value - bright.x + bright.y, 0.0, 2.0 * bright.y);
    float above = max(soft * soft / max(4.0 * bright.y, 1e-10), value - bright.x);
    return c * (max(above, 0.0) / max(given, 1e-10));
}
