// SPDX-License-Identifier: MIT
// What stands between the first SHADOWS lights and a place, as core/shadow.h has it; gl/shadow_pass.h packs the block.
layout(std140, binding = 5) uniform Shadows
{
    mat4 shadow_lens[4];  // rows across, up, depth, width, for vector * matrix
    mat4 snow_lens[4];
    vec4 shadow_texel;    // m where the width is 1, by light
    vec4 snow_counts;     // 1: flakes dim this light
    vec4 snow_layers;     // slices; layers of one light, over all layers; 0; 0
};
#ifdef SHADOW_MAPS
layout(binding = 3) uniform sampler2DArrayShadow shadow_maps;
#endif
#ifdef SNOW_SHADE
layout(binding = 4) uniform sampler3D snow_depths;  // optical depth up to each end of a slice, light by light
#endif

bool on_map(vec2 at) { return all(greaterThanEqual(at, vec2(0.0))) && all(lessThanEqual(at, vec2(1.0))); }

float unhidden_share(uint light, vec3 p)
{
#ifdef SHADOW_MAPS
    vec4 at = vec4(p, 1.0) * shadow_lens[light];
    vec3 place = at.xyz / at.w;
    if (at.w <= 0.0 || !on_map(place.xy)) return 1.0;
    return texture(shadow_maps, vec4(place.xy, float(light), min(place.z, 1.0)));
#else
    return 1.0;
#endif
}

float past_snow(uint light, vec3 p)
{
#ifdef SNOW_SHADE
    if (snow_counts[light] == 0.0) return 1.0;
    vec4 at = vec4(p, 1.0) * snow_lens[light];
    vec2 place = at.xy / at.w;
    if (at.w <= 0.0 || at.z <= 0.0 || !on_map(place)) return 1.0;
    float layer = float(light) * (snow_layers.x + 1.0) + 0.5 + min(at.z, 1.0) * snow_layers.x;
    return exp(-texture(snow_depths, vec3(place, layer * snow_layers.y)).r);
#else
    return 1.0;
#endif
}

// Share of a light that reaches a place.
float lit_share(uint light, vec3 p)
{
    if (light >= uint(SHADOWS)) return 1.0;
    return unhidden_share(light, p) * past_snow(light, p);
}

// The same on a surface, which must not hide itself from the light: looked up a little off it.
float lit_share(uint light, vec3 p, vec3 normal)
{
    if (light >= uint(SHADOWS)) return 1.0;
    float width = dot(vec4(p, 1.0), shadow_lens[light][3]);
    return lit_share(light, p + normal * (1.5 * shadow_texel[light] * width));
}
