// SPDX-License-Identifier: MIT
#define VARYING out
#include "develop_constants.glsl"
layout(std140, binding = 2) uniform Exposure { vec4 exposure_block; };  // factor; its log2; log2 of the mean luminance; 0
layout(location = 0) uniform vec3 bright_in;
#ifdef TONE
layout(location = 1) uniform vec3 tone_in;
#endif
#ifdef BLOOM
layout(location = 2) uniform vec3 mixing_in;
layout(std140, binding = 3) uniform Command { uvec4 command; };  // no vertices: the chain found nothing bright
#endif

void main()
{
    exposure = exposure_block.x;
    bright = vec4(bright_in, bright_in.x - bright_in.y);
#ifdef TONE
    tone = tone_in;
#endif
#ifdef BLOOM
    mixing = vec3(command.x != 0u ? mixing_in.x : 0.0, mixing_in.yz);
#endif
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
