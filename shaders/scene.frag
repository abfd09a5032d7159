// SPDX-License-Identifier: MIT
// Lambert surfaces under ambient light and every active light; both faces are lit. With SHINY the lobe of core/surface.h on top.
#define VARYING in
#include "scene_constants.glsl"
layout(location = 0) out vec4 colour;

struct Lit
{
    vec3 matt;
    vec3 mirrored;  // with SHINY
};

void add_lamp(uint index, Light lamp, vec3 n, vec3 to_eye, inout Lit lit)
{
    vec3 to_light;
    vec3 e = irradiance(lamp, place, to_light);
#ifdef AIR
    if (lamp.place.w != 0.0) e *= reaching(lamp.place.xyz + eye_time.xyz, place + eye_time.xyz);
#endif
#ifdef SHADOWS
    e *= lit_share(index, place + eye_time.xyz, n);
#endif
    float facing = max(dot(n, to_light), 0.0);
    lit.matt += e * (facing * 0.318309886);
#ifdef SHINY
    vec3 between = to_light + to_eye;
    float halfway = max(dot(n, between), 0.0) * inversesqrt(max(dot(between, between), 1e-12));
    lit.mirrored += e * (facing * pow(halfway, gloss.w));
#endif
}

void main()
{
    vec3 n = normal * inversesqrt(max(dot(normal, normal), 1e-20));
    if (dot(n, place) > 0.0) n = -n;
    vec3 around = ambient * (0.75 + 0.25 * n.z);
    vec3 to_eye = -place * inversesqrt(max(dot(place, place), 1e-20));
    Lit lit = Lit(vec3(0.0), vec3(0.0));
#ifdef FLAT_LIGHTS
    for (uint i = 0u; i < kLightCount; ++i) add_lamp(i, lamps[i], n, to_eye, lit);
#else
    uint cluster = cluster_at(gl_FragCoord.xy, dot(place, forward_near.xyz));
    EACH_LIGHT(cluster, add_lamp(i, seen_from(lights[i], eye_time.xyz), n, to_eye, lit));
#endif
#ifdef SHINY
    colour = vec4(min(albedo * around + matt * lit.matt + gloss.rgb * lit.mirrored + emission, 6e4), 1.0);
#else
    colour = vec4(min(albedo * (around + lit.matt) + emission, 6e4), 1.0);
#endif
}
