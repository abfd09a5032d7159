// SPDX-License-Identifier: MIT
// Half the size by five overlapping boxes. Source: J. Jimenez, Next generation post processing in Call of Duty: Advanced Warfare,
// SIGGRAPH 2014.
layout(binding = 0) uniform sampler2D from;
layout(location = 0) out vec4 colour;

void main()
{
    vec2 texel = 1.0 / vec2(textureSize(from, 0));
    vec2 middle = 2.0 * gl_FragCoord.xy;
#define TAP(X, Y) texture(from, (middle + vec2(X, Y)) * texel).rgb
    vec3 inner = TAP(-1, -1) + TAP(1, -1) + TAP(-1, 1) + TAP(1, 1);
    vec3 edges = TAP(-2, 0) + TAP(2, 0) + TAP(0, -2) + TAP(0, 2);
    vec3 corners = TAP(-2, -2) + TAP(2, -2) + TAP(-2, 2) + TAP(2, 2);
    colour = vec4(0.125 * (inner + TAP(0, 0)) + 0.0625 * edges + 0.03125 * corners, 1.0);
}
