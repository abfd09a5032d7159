// SPDX-License-Identifier: MIT
// Lambert surfaces under ambient light and every active light; both faces are lit.
#define VARYING in
#include "scene_constants.glsl"
layout(location = 0) out vec4 colour;

void main()
{
    vec3 n = normal * inversesqrt(max(dot(normal, normal), 1e-20));
    if (dot(n, place) > 0.0) n = -n;
    vec3 sum = ambient * (0.75 + 0.25 * n.z);
    for (uint i = 0u; i < kLightCount; ++i)
    {
#ifdef FLAT_LIGHTS
        Light lamp = lamps[i];
#else
        Light lamp = seen_from(lights[i], eye_time.xyz);
#endif
        vec3 to_light;
        vec3 e = irradiance(lamp, place, to_light);
        sum += e * (max(dot(n, to_light), 0.0) * 0.318309886);
    }
    colour = vec4(min(albedo * sum + emission, 6e4), 1.0);
}
