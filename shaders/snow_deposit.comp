// SPDX-License-Identifier: MIT
// Lays the area that each living flake hides into the slice and texels that a light sees it in. In whole numbers, so that
// the order of the flakes does not matter.
#include "flake_look.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer XArray { float x_m[]; };
layout(std430, binding = 1) readonly buffer YArray { float y_m[]; };
layout(std430, binding = 2) readonly buffer ZArray { float z_m[]; };
layout(std430, binding = 3) readonly buffer IdArray { uint ids[]; };
layout(std430, binding = 6) readonly buffer StateArray { uint states[]; };
layout(std430, binding = 7) buffer Cells { uint cells[]; };  // optical depth in 2^-16, slice by slice
layout(location = 0) uniform uint slots;
layout(location = 1) uniform mat4 lens;
layout(location = 2) uniform uvec3 size;  // texels of a side, slices, first layer of cells
layout(location = 3) uniform vec4 look;   // mean melted diameter (mm), half the flake_scale, area over squared radius, edge of a texel (m)
layout(location = 4) uniform uint seed;

const float kOne = 65536.0;

// A flake is laid over a square in which its optical depth is no more than this: what falls at random then hides as much as
// it covers, to half of this.
const float kMostDepth = 0.02;
const float kWidest = 24.0;  // texels

void add(vec2 texel, uint slice, float depth)
{
    uvec2 at = uvec2(clamp(texel, vec2(0.0), vec2(float(size.x) - 1.0)));
    atomicAdd(cells[((size.z + slice) * size.x + at.y) * size.x + at.x], uint(depth * kOne + 0.5));
}

// Share of a square from low to high that lies over a texel, on each axis.
vec2 over(vec2 texel, vec2 low, vec2 high) { return max(min(high, texel + 1.0) - max(low, texel), 0.0) / (high - low); }

void main()
{
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= slots || (states[slot] & 255u) != 0u) return;
    vec3 p = vec3(x_m[slot], y_m[slot], z_m[slot]);
    vec4 at = vec4(p, 1.0) * lens;
    vec2 place = at.xy / at.w;
    // A place that is not a number fails, too.
    bool seen = at.w > 0.0 && at.z > 0.0 && at.z <= 1.0 && place.x >= 0.0 && place.x <= 1.0 && place.y >= 0.0 && place.y <= 1.0;
    if (!seen) return;
    float radius_m = look.y * flake_diameter(look_unit(look_hash(mix32(ids[slot] ^ seed), 0u)), look.x);
    float texel_m = look.w * at.w;
    float depth = look.z * radius_m * radius_m / (texel_m * texel_m);
    float wide = clamp(sqrt(depth / kMostDepth), 1.0, kWidest);
    depth = min(depth, wide * wide);
    uint slice = min(uint(at.z * float(size.y)), size.y - 1u);
    vec2 low = place * float(size.x) - 0.5 * wide;
    vec2 high = low + wide;
    for (float y = floor(low.y); y < high.y; y += 1.0)
        for (float x = floor(low.x); x < high.x; x += 1.0)
        {
            vec2 share = over(vec2(x, y), low, high);
            add(vec2(x, y), slice, depth * share.x * share.y);
        }
}
