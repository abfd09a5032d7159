// SPDX-License-Identifier: MIT
#define VARYING out
#include "scene_constants.glsl"
layout(location = 0) in vec3 position_m;
layout(location = 1) in vec3 normal_in;
layout(location = 0) uniform vec3 offset_m;  // of the vehicle that carries the mesh
layout(location = 1) uniform vec3 material_albedo;
layout(location = 2) uniform vec3 material_emission;
#ifdef SHINY
layout(location = 3) uniform vec4 material_gloss;
layout(location = 4) uniform vec3 material_matt;
#endif

void main()
{
    vec3 p = position_m + offset_m;
    place = p - eye_time.xyz;
    normal = normal_in;
    albedo = material_albedo;
    emission = material_emission;
    ambient = ambient_far.rgb;
#ifdef SHINY
    gloss = material_gloss;
    matt = material_matt;
#endif
#ifdef FLAT_LIGHTS
    for (uint i = 0u; i < kLightCount; ++i) lamps[i] = seen_from(lights[i], eye_time.xyz);
#endif
    gl_Position = clip_from_view(view_from_local(p), vec2(1.0));
}
