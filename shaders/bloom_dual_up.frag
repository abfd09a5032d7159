// SPDX-License-Identifier: MIT
// Twice the size by eight taps. Source: as bloom_dual_down.frag.
layout(binding = 0) uniform sampler2D from;
layout(location = 0) out vec4 colour;

void main()
{
    vec2 texel = 1.0 / vec2(textureSize(from, 0));
    vec2 middle = 0.5 * gl_FragCoord.xy;
#define TAP(X, Y) texture(from, (middle + vec2(X, Y)) * texel).rgb
    vec3 sides = TAP(-1.0, 0.0) + TAP(1.0, 0.0) + TAP(0.0, -1.0) + TAP(0.0, 1.0);
    vec3 corners = TAP(-0.5, -0.5) + TAP(0.5, -0.5) + TAP(-0.5, 0.5) + TAP(0.5, 0.5);
    colour = vec4((sides + 2.0 * corners) / 12.0, 1.0);
}
