// SPDX-License-Identifier: MIT
// Splits a list of flakes, far to near, at a distance from the eye: one thread halves the range, as the host does where it
// can read the list. In double, so that both find the same place.
layout(local_size_x = 1) in;
layout(std430, binding = 0) readonly buffer XArray { float x_m[]; };
layout(std430, binding = 1) readonly buffer YArray { float y_m[]; };
layout(std430, binding = 2) readonly buffer ZArray { float z_m[]; };
layout(std430, binding = 4) readonly buffer DrawList { uvec2 draw_list[]; };  // slot, depth key
struct DrawCommand { uint count, instances, first, base; };
layout(std430, binding = 6) writeonly buffer DrawCommands { DrawCommand beyond, within; };
layout(location = 0) uniform uint count;
layout(location = 1) uniform vec3 eye_m;
layout(location = 2) uniform double border_m;

void main()
{
    uint low = 0u;
    uint high = count;
    while (low < high)
    {
        uint middle = low + (high - low) / 2u;
        uint slot = draw_list[middle].x;
        dvec3 d = dvec3(x_m[slot], y_m[slot], z_m[slot]) - dvec3(eye_m);
        if (dot(d, d) > border_m * border_m)
            low = middle + 1u;
        else
            high = middle;
    }
    beyond = DrawCommand(low, 1u, 0u, 0u);
    within = DrawCommand(count - low, 1u, low, 0u);
}
