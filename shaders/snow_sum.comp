// SPDX-License-Identifier: MIT
// Sums the slices from the light on: the optical depth up to each of their ends. Leaves the cells empty.
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 7) buffer Cells { uint cells[]; };
layout(r32f, binding = 0) uniform writeonly image3D depths;
layout(location = 0) uniform uvec2 size;  // texels of a side, slices

void main()
{
    uvec3 at = gl_GlobalInvocationID;  // z: the light
    if (at.x >= size.x || at.y >= size.x) return;
    ivec3 place = ivec3(at.xy, at.z * (size.y + 1u));
    imageStore(depths, place, vec4(0.0));
    uint sum = 0u;
    for (uint slice = 0u; slice < size.y; ++slice)
    {
        uint cell = ((at.z * size.y + slice) * size.x + at.y) * size.x + at.x;
        sum += cells[cell];
        cells[cell] = 0u;
        imageStore(depths, place + ivec3(0, 0, int(slice) + 1), vec4(float(sum) / 65536.0));
    }
}
