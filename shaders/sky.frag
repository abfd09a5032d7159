// SPDX-License-Identifier: MIT
in vec3 ray;
flat in vec3 horizon;
flat in vec3 rise;
layout(location = 0) out vec4 colour;

void main()
{
    float up = max(ray.z, 0.0) * inversesqrt(dot(ray, ray));
    colour = vec4(horizon + rise * sqrt(up), 1.0);
}
