// SPDX-License-Identifier: MIT
// Fills the grids of glow (core/glow_grid.h): each call integrates one way, step by step. The points of airlight.glsl would be
// far too many between two nodes; two are enough.
#include "frame.glsl"
#include "lights.glsl"
#include "airlight.glsl"
layout(local_size_x = 32) in;

// Unit vector of the way of a ring and a turn.
vec3 glow_way(GlowAxes axes, int ring, int turn)
{
    float root = float(ring) / float(kGlowRings);
    float chord = axes.widest_chord * root * root;
    float quarter = 4.0 * float(turn) / float(kGlowTurns) - 1.0;
    float over = quarter > 1.0 ? 2.0 - quarter : quarter;
    float across = quarter > 1.0 ? abs(over) - 1.0 : 1.0 - abs(over);
    float sine = chord * sqrt(max(1.0 - 0.25 * chord * chord, 0.0)) * inversesqrt(across * across + over * over);
    return axes.axis * (1.0 - 0.5 * chord * chord) + (axes.across * across + axes.over * over) * sine;
}

float part_of_step(uint index, Light light, AirPath path, GlowSpan span, float from, float to)
{
    if (to <= from) return 0.0;
    float middle = 0.5 * (from + to);
    float wide = 0.5 * (to - from);
    return wide * (glow_at(index, light, path, span.nearest, span.least, middle - 0.57735027 * wide) +
                   glow_at(index, light, path, span.nearest, span.least, middle + 0.57735027 * wide));
}

void main()
{
    const int columns = (kGlowRings + 1) * (kGlowTurns + 1);
    int column = int(gl_GlobalInvocationID.x);
    uint index = gl_GlobalInvocationID.y;
    int grid = glow_grid(index);
    if (column >= columns || grid < 0) return;
    Light light = lights[index];
    GlowAxes axes = glow_axes(light);
    AirPath path = air_path(normalize(glow_way(axes, column / (kGlowTurns + 1), column % (kGlowTurns + 1))));
    GlowSpan span = glow_span(light, axes, path.way);
    // Cut where the way enters and leaves the flakes' volume.
    float enter = glow_angle(span, path.enters);
    float leave = glow_angle(span, path.leaves);
    int at = grid + column * (kGlowSteps + 1);
    float sum = 0.0;
    float from = span.begin;
    cluster_bits[at] = floatBitsToUint(glow_at(index, light, path, span.nearest, span.least, from));
    for (int i = 1; i <= kGlowSteps; ++i)
    {
        float root = float(i) / float(kGlowSteps);
        float to = mix(span.begin, span.end, root * root);
        float cut = clamp(enter, from, to);
        float last = clamp(leave, cut, to);
        sum += part_of_step(index, light, path, span, from, cut);
        sum += part_of_step(index, light, path, span, cut, last);
        sum += part_of_step(index, light, path, span, last, to);
        float turned = to - span.begin;
        cluster_bits[at + i] = turned > 1e-6 ? floatBitsToUint(sum / turned) : cluster_bits[at];
        from = to;
    }
}
