// SPDX-License-Identifier: MIT
// The scene's depth for every sample of a pixel.
layout(binding = 0) uniform sampler2D scene_depth;

void main() { gl_FragDepth = texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).r; }
