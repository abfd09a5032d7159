// SPDX-License-Identifier: MIT
// The farthest depth of the scene in each tile of 8x8 pixels: what lies behind it is hidden in the whole tile.
layout(binding = 0) uniform sampler2D scene_depth;
layout(location = 0) out float farthest;

const int kTile = 8;

void main()
{
    // Gathers start at the texels' corners; past the border of the picture they repeat its last texels.
    vec2 texel = 1.0 / vec2(textureSize(scene_depth, 0));
    vec2 corner = floor(gl_FragCoord.xy) * float(kTile) + 1.0;
    vec4 low = vec4(1.0);
    for (int y = 0; y < kTile; y += 2)
        for (int x = 0; x < kTile; x += 2) low = min(low, textureGather(scene_depth, (corner + vec2(x, y)) * texel));
    farthest = min(min(low.x, low.y), min(low.z, low.w));
}
