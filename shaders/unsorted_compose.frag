// SPDX-License-Identifier: MIT
// Flakes that were blended without a sort, over the picture: premultiplied.
layout(binding = 0) uniform sampler2D sum;
#ifdef SHARED
layout(binding = 1) uniform sampler2D left;  // of what lies behind
#endif
layout(location = 0) out vec4 colour;

void main()
{
    vec4 all = texelFetch(sum, ivec2(gl_FragCoord.xy), 0);
#ifdef SHARED
    float covered = 1.0 - texelFetch(left, ivec2(gl_FragCoord.xy), 0).r;
    colour = all.a > 0.0 ? vec4(all.rgb / all.a, 1.0) * covered : vec4(0.0);
#else
    colour = all;
#endif
}
