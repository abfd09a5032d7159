// SPDX-License-Identifier: MIT
layout(location = 0) in vec4 point;  // normalised device coordinates, diameter (px)

void main()
{
    gl_Position = vec4(point.xyz, 1.0);
    gl_PointSize = point.w;
}
