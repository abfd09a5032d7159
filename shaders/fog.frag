// SPDX-License-Identifier: MIT
// What snow-filled air does to scene and sky: colour = picture * alpha + rgb, by the blending. The sky counts as the far plane.
#include "frame.glsl"
#include "lights.glsl"
#include "airlight.glsl"
layout(binding = 0) uniform sampler2D scene_depth;
in vec3 ray;
layout(location = 0) out vec4 colour;

void main()
{
    float far = length(ray);
    AirPath path = air_path(ray / far);
    float z = scene_z(texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).r);
    float to = z * far;
    uint cluster = cluster_at(gl_FragCoord.xy, z);
#ifdef GLOW
    colour = vec4(min(lamp_glow(path, to, cluster), 6e4), 1.0);
#else
    float clear = clear_share(path, to);
    colour = vec4(min(even_light(path, to, cluster), 6e4) * (1.0 - clear), clear);
#endif
}
