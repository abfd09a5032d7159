// SPDX-License-Identifier: MIT
// Twice the size by a tent of 3 x 3. Source: as bloom_down13.frag.
layout(binding = 0) uniform sampler2D from;
layout(location = 0) out vec4 colour;

void main()
{
    vec2 texel = 1.0 / vec2(textureSize(from, 0));
    vec2 middle = 0.5 * gl_FragCoord.xy;
#define TAP(X, Y) texture(from, (middle + vec2(X, Y)) * texel).rgb
    vec3 edges = TAP(-1, 0) + TAP(1, 0) + TAP(0, -1) + TAP(0, 1);
    vec3 corners = TAP(-1, -1) + TAP(1, -1) + TAP(-1, 1) + TAP(1, 1);
    colour = vec4(0.25 * TAP(0, 0) + 0.125 * edges + 0.0625 * corners, 1.0);
}
