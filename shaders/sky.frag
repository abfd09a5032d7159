// SPDX-License-Identifier: MIT
#include "frame.glsl"
in vec3 ray;
layout(location = 0) out vec4 colour;

void main()
{
    float up = ray.z * inversesqrt(dot(ray, ray));
    colour = vec4(mix(horizon_focal.rgb, zenith_exposure.rgb, sqrt(clamp(up, 0.0, 1.0))), 1.0);
}
