// SPDX-License-Identifier: MIT
// Lambert surfaces under ambient light and every active light; both faces are lit.
#include "frame.glsl"
#include "lights.glsl"
layout(location = 1) uniform vec3 albedo;
layout(location = 2) uniform vec3 emission;
in vec3 place;
in vec3 normal;
layout(location = 0) out vec4 colour;

void main()
{
    vec3 n = normal * inversesqrt(max(dot(normal, normal), 1e-20));
    if (dot(n, eye_time.xyz - place) < 0.0) n = -n;
    vec3 sum = ambient_far.rgb * (0.75 + 0.25 * n.z);
    for (uint i = 0u; i < kLightCount; ++i)
    {
        vec3 to_light;
        vec3 e = irradiance(lights[i], place, to_light);
        sum += e * (max(dot(n, to_light), 0.0) * 0.318309886);
    }
    colour = vec4(min(albedo * sum + emission, 6e4), 1.0);
}
