// SPDX-License-Identifier: MIT
// Lamps' glow by the nodes of a grid, as core/glow_grid.h has it. They lie behind the bits of the clusters: the number of each
// light's grid, then the grids.
const int kGlowRings = 20, kGlowTurns = 24, kGlowSteps = 20;
const int kGlowNodes = (kGlowRings + 1) * (kGlowTurns + 1) * (kGlowSteps + 1);

struct GlowAxes
{
    vec3 to_lamp, axis, across, over;
    float widest_chord;
};

GlowAxes glow_axes(Light light)
{
    GlowAxes axes;
    axes.to_lamp = light.place.xyz - eye_time.xyz;
    float away = max(length(axes.to_lamp), 1e-6);
    axes.axis = axes.to_lamp / away;
    vec2 level = abs(axes.axis.x) + abs(axes.axis.y) < 1e-6 ? vec2(1.0, 0.0) : axes.axis.xy;
    axes.across = vec3(-level.y, level.x, 0.0) * inversesqrt(dot(level, level));
    axes.over = cross(axes.axis, axes.across);
    float sine = 1.0 / (light.limits.y * away);
    axes.widest_chord = sine < 1.0 ? sine * sqrt(2.0 / (1.0 + sqrt(1.0 - sine * sine))) : 2.0;
    return axes;
}

struct GlowSpan
{
    float nearest, least, from, to, begin, end;
};

float glow_angle(GlowSpan span, float at) { return atan((at - span.nearest) / span.least); }

GlowSpan glow_span(Light light, GlowAxes axes, vec3 way)
{
    GlowSpan span;
    span.nearest = dot(axes.to_lamp, way);
    vec3 aside = axes.to_lamp - way * span.nearest;
    float aside2 = dot(aside, aside);
    span.least = max(sqrt(aside2), kNearestLight);
    float root = sqrt(max(1.0 / (light.limits.y * light.limits.y) - aside2, 0.0));
    span.from = max(span.nearest - root, 0.0);
    span.to = max(span.nearest + root, span.from);
    span.begin = glow_angle(span, span.from);
    span.end = glow_angle(span, span.to);
    return span;
}

// Where the nodes of a light's grid begin, or -1.
int glow_grid(uint index)
{
    int number = int(cluster_bits[2u * cluster_ways + index]);
    return number < 0 ? -1 : int(2u * cluster_ways + kLightCount) + number * kGlowNodes;
}

float glow_node(int at) { return uintBitsToFloat(cluster_bits[at]); }

// Between two nodes: the first, and the share of the second.
vec2 glow_cell(float at, int intervals)
{
    float inside = clamp(at, 0.0, float(intervals));
    float low = min(floor(inside), float(intervals - 1));
    return vec2(low, inside - low);
}

float glow_along(int at, float share) { return mix(glow_node(at), glow_node(at + 1), share); }

float glow_around(int at, float turn, float step)
{
    return mix(glow_along(at, step), glow_along(at + kGlowSteps + 1, step), turn);
}

// Glow of a light of intensity 1 on a way, by its grid.
float glow_in_grid(int grid, Light light, vec3 way, float to)
{
    GlowAxes axes = glow_axes(light);
    GlowSpan span = glow_span(light, axes, way);
    float turned = glow_angle(span, clamp(to, span.from, span.to)) - span.begin;
    vec2 ring = glow_cell(sqrt(length(way - axes.axis) / axes.widest_chord) * float(kGlowRings), kGlowRings);
    float across = dot(way, axes.across);
    float over = dot(way, axes.over);
    float tilt = over / max(abs(across) + abs(over), 1e-12);
    float quarter = across < 0.0 ? 3.0 - tilt : tilt + 1.0;
    vec2 turn = glow_cell(quarter * (0.25 * float(kGlowTurns)), kGlowTurns);
    vec2 step = glow_cell(sqrt(turned / max(span.end - span.begin, 1e-9)) * float(kGlowSteps), kGlowSteps);
    int at = grid + (int(ring.x) * (kGlowTurns + 1) + int(turn.x)) * (kGlowSteps + 1) + int(step.x);
    float mean = mix(glow_around(at, turn.y, step.y),
                     glow_around(at + (kGlowTurns + 1) * (kGlowSteps + 1), turn.y, step.y), ring.y);
    return mean * turned / span.least;
}
