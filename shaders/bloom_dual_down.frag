// SPDX-License-Identifier: MIT
// Half the size by five taps. Source: M. Bjørge, Bandwidth-efficient rendering, SIGGRAPH 2015 (dual filter).
layout(binding = 0) uniform sampler2D from;
layout(location = 0) out vec4 colour;

void main()
{
    vec2 texel = 1.0 / vec2(textureSize(from, 0));
    vec2 middle = 2.0 * gl_FragCoord.xy;
#define TAP(X, Y) texture(from, (middle + vec2(X, Y)) * texel).rgb
    colour = vec4(0.5 * TAP(0, 0) + 0.125 * (TAP(-1, -1) + TAP(1, -1) + TAP(-1, 1) + TAP(1, 1)), 1.0);
}
