// SPDX-License-Identifier: MIT
// What a pixel counts as (core/bloom.h). NaN compares false.
vec3 contained(vec3 c)
{
    return mix(vec3(0.0), min(c, vec3(65504.0)), greaterThan(c, vec3(0.0)));
}
