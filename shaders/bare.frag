// SPDX-License-Identifier: MIT
layout(location = 0) out vec4 colour;

void main() { colour = vec4(0.25, 0.25, 0.25, 0.5); }
