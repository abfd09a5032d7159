// SPDX-License-Identifier: MIT
// One triangle over the picture at the far plane: what the scene left free.
#include "frame.glsl"
out vec3 ray;
flat out vec3 horizon;  // not uniforms: see scene_constants.glsl
flat out vec3 rise;     // from there to the zenith

void main()
{
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    ray = forward_near.xyz + corner.x * right_tan.w * right_tan.xyz + corner.y * up_tan.w * up_tan.xyz;
    horizon = horizon_focal.rgb;
    rise = zenith.rgb - horizon;
    gl_Position = vec4(corner, 0.0, 1.0);
}
