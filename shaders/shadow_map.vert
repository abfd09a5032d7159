// SPDX-License-Identifier: MIT
// Solid things as a lamp sees them: depth alone.
layout(location = 0) in vec3 position_m;
layout(location = 0) uniform vec3 offset_m;  // of the vehicle that carries the mesh
layout(location = 1) uniform mat4 lens;      // of the lamp: rows across, up, depth, width, as core/shadow.h has them

void main()
{
    vec4 at = vec4(position_m + offset_m, 1.0) * lens;
    gl_Position = vec4(2.0 * at.xy - at.w, at.z, at.w);
}
