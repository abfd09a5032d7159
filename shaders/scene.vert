// SPDX-License-Identifier: MIT
#include "frame.glsl"
layout(location = 0) in vec3 position_m;
layout(location = 1) in vec3 normal_in;
layout(location = 0) uniform vec3 offset_m;  // of the vehicle that carries the mesh
out vec3 place;
out vec3 normal;

void main()
{
    place = position_m + offset_m;
    normal = normal_in;
    gl_Position = clip_from_view(view_from_local(place), vec2(1.0));
}
