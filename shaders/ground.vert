// SPDX-License-Identifier: MIT
// The ground plane: a square round the eye that reaches beyond the far plane, which clips it.
#include "frame.glsl"
layout(location = 0) uniform vec3 offset_m;  // z: height of the ground
out vec3 place;
out vec3 normal;

void main()
{
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    // The farthest seen point lies in a corner of the picture.
    float reach = 1.5 * ambient_far.w * length(vec3(right_tan.w, up_tan.w, 1.0));
    place = vec3(eye_time.xy + corner * reach, offset_m.z);
    normal = vec3(0.0, 0.0, 1.0);
    gl_Position = clip_from_view(view_from_local(place), vec2(1.0));
}
