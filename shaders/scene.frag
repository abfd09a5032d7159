// SPDX-License-Identifier: MIT
// Lambert surfaces under ambient light and every active light; both faces are lit. With SHINY the lobe of core/surface.h on top.
#define VARYING in
#include "scene_constants.glsl"
layout(location = 0) out vec4 colour;

void main()
{
    vec3 n = normal * inversesqrt(max(dot(normal, normal), 1e-20));
    if (dot(n, place) > 0.0) n = -n;
    vec3 around = ambient * (0.75 + 0.25 * n.z);
    vec3 lit = vec3(0.0);
#ifdef SHINY
    vec3 to_eye = -place * inversesqrt(max(dot(place, place), 1e-20));
    vec3 mirrored = vec3(0.0);
#endif
    for (uint i = 0u; i < kLightCount; ++i)
    {
#ifdef FLAT_LIGHTS
        Light lamp = lamps[i];
#else
        Light lamp = seen_from(lights[i], eye_time.xyz);
#endif
        vec3 to_light;
        vec3 e = irradiance(lamp, place, to_light);
#ifdef AIR
        if (lamp.place.w != 0.0) e *= reaching(lamp.place.xyz + eye_time.xyz, place + eye_time.xyz);
#endif
#ifdef SHADOWS
        e *= lit_share(i, place + eye_time.xyz, n);
#endif
        float facing = max(dot(n, to_light), 0.0);
        lit += e * (facing * 0.318309886);
#ifdef SHINY
        vec3 between = to_light + to_eye;
        float halfway = max(dot(n, between), 0.0) * inversesqrt(max(dot(between, between), 1e-12));
        mirrored += e * (facing * pow(halfway, gloss.w));
#endif
    }
#ifdef SHINY
    colour = vec4(min(albedo * around + matt * lit + gloss.rgb * mirrored + emission, 6e4), 1.0);
#else
    colour = vec4(min(albedo * (around + lit) + emission, 6e4), 1.0);
#endif
}
