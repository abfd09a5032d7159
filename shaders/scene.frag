// SPDX-License-Identifier: MIT
// Lambert surfaces under ambient light and every active light; both faces are lit. With SHINY the lobe of core/surface.h on top.
#include "frame.glsl"
#include "lights.glsl"
layout(location = 1) uniform vec3 albedo;
layout(location = 2) uniform vec3 emission;
#ifdef SHINY
layout(location = 3) uniform vec4 gloss;  // share that is mirrored, exponent
layout(location = 4) uniform vec3 matt;   // albedo of the rest
#endif
in vec3 place;
in vec3 normal;
layout(location = 0) out vec4 colour;

void main()
{
    vec3 n = normal * inversesqrt(max(dot(normal, normal), 1e-20));
    vec3 way = eye_time.xyz - place;
    if (dot(n, way) < 0.0) n = -n;
    vec3 ambient = ambient_far.rgb * (0.75 + 0.25 * n.z);
    vec3 lamps = vec3(0.0);
#ifdef SHINY
    vec3 to_eye = way * inversesqrt(max(dot(way, way), 1e-20));
    vec3 mirrored = vec3(0.0);
#endif
    for (uint i = 0u; i < kLightCount; ++i)
    {
        vec3 to_light;
        vec3 e = irradiance(lights[i], place, to_light);
        e *= max(dot(n, to_light), 0.0);
        lamps += e * 0.318309886;
#ifdef SHINY
        vec3 half_way = to_light + to_eye;
        float facing = max(dot(n, half_way), 0.0) / max(length(half_way), 1e-6);
        mirrored += e * ((gloss.w + 8.0) * 0.0397887358 * pow(facing, gloss.w));
#endif
    }
#ifdef SHINY
    colour = vec4(min(albedo * ambient + matt * lamps + gloss.rgb * mirrored + emission, 6e4), 1.0);
#else
    colour = vec4(min(albedo * (ambient + lamps) + emission, 6e4), 1.0);
#endif
}
