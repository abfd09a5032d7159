// SPDX-License-Identifier: MIT
// What lamps make of the air, as core/airlight.h has it: scattered once, eight Gauss-Legendre points over the angle at
// which the lamp sees the way.

#ifdef GLOW_GRIDS
#include "glow_grid.glsl"
#endif

const vec4 kPlace = vec4(0.18343464, 0.52553241, 0.79666648, 0.96028986);
const vec4 kWeight = vec4(0.36268378, 0.31370665, 0.22238103, 0.10122854);

// The part of a way that a lamp's range and cone reach: x to y, empty if y <= x.
vec2 lit_part(Light light, vec3 way, vec2 part)
{
    vec3 away = eye_time.xyz - light.place.xyz;
    float along = dot(away, way);
    float across2 = dot(away, away) - along * along;
    if (light.limits.y > 0.0)
    {
        float inside = 1.0 / (light.limits.y * light.limits.y) - across2;
        if (inside <= 0.0) return vec2(0.0);
        float root = sqrt(inside);
        part = vec2(max(part.x, -along - root), min(part.y, root - along));
    }
    if (light.direction.w == 0.0) return part;
    float cosine = -light.limits.x / light.direction.w;
    float cos2 = cosine * cosine;
    float u0 = dot(light.direction.xyz, away);
    float u1 = dot(light.direction.xyz, way);
    float a = u1 * u1 - cos2;
    float b = u0 * u1 - cos2 * along;
    float c = u0 * u0 - cos2 * dot(away, away);
    float determinant = b * b - a * c;
    if (abs(a) < 1e-9)
    {
        if (abs(b) < 1e-9) return c > 0.0 && u0 > 0.0 ? part : vec2(0.0);
        float at = -0.5 * c / b;
        return b > 0.0 ? vec2(max(part.x, at), part.y) : vec2(part.x, min(part.y, at));
    }
    if (determinant < 0.0) return a > 0.0 && u0 > 0.0 ? part : vec2(0.0);
    float root = sqrt(determinant);
    float first = min((-b - root) / a, (root - b) / a);
    float second = max((-b - root) / a, (root - b) / a);
    if (a < 0.0)
        return u0 + u1 * 0.5 * (first + second) > 0.0 ? vec2(max(part.x, first), min(part.y, second)) : vec2(0.0);
    return u1 > 0.0 ? vec2(max(part.x, second), part.y) : vec2(part.x, min(part.y, first));
}

float glow_at(uint index, Light light, AirPath path, float nearest, float least, float angle)
{
    float sine = sin(angle);
    float cosine = cos(angle);
    float at = nearest + least * sine / cosine;
    float away = least / cosine;
    vec3 place = eye_time.xyz + path.way * at;
    float depth = of_fog(path, at) + optical_depth(light.place.z, place.z, away);
    float spot = clamp(dot(place - light.place.xyz, light.direction.xyz) / away * light.direction.w + light.limits.x, 0.0, 1.0);
    float reach = away * light.limits.y;
    float window = max(1.0 - reach * reach * reach * reach, 0.0);
    return spot * spot * window * fog_at(path, at) * exp(-depth) * phase(light, -sine) * lit_share(index, place);
}

vec3 airlight(uint index, Light light, AirPath path, vec2 part)
{
    vec2 lit = lit_part(light, path.way, part);
    if (lit.y <= lit.x) return vec3(0.0);
    vec3 to_lamp = light.place.xyz - eye_time.xyz;
    float nearest = dot(to_lamp, path.way);
    // The distance itself, as its square is a difference of large numbers.
    float least = max(length(to_lamp - path.way * nearest), kNearestLight);
    float first = atan((lit.x - nearest) / least);
    float last = atan((lit.y - nearest) / least);
    float middle = 0.5 * (first + last);
    float wide = 0.5 * (last - first);
    float sum = 0.0;
    for (int k = 0; k < 4; ++k)
        sum += kWeight[k] * (glow_at(index, light, path, nearest, least, middle - wide * kPlace[k]) +
                             glow_at(index, light, path, nearest, least, middle + wide * kPlace[k]));
    return light.intensity.rgb * (sum * wide / least);
}

vec3 airlight_to(uint index, AirPath path, float to)
{
    Light light = lights[index];
    float enter = min(path.enters, to);
    float leave = min(path.leaves, to);
    vec3 sum = airlight(index, light, path, vec2(leave, to));
    if (enter > 0.0) sum += airlight(index, light, path, vec2(0.0, enter));
    if (leave > enter) sum += airlight(index, light, path, vec2(enter, leave));
    return sum;
}

// Share of a parallel light that reaches the fog, each part counting by what the eye gets of it: eight points at equal
// shares of an even fog's light.
float share_in_fog(uint index, AirPath path, float to)
{
    float depth = of_fog(path, to);
    float hidden = 1.0 - exp(-depth);
    bool thin = depth < 1e-3;
    float per_m = (thin ? 1.0 : depth) / to;
    float lit = 0.0;
    float all = 0.0;
    for (int k = 0; k < 8; ++k)
    {
        float share = 0.5 + (k < 4 ? -0.5 : 0.5) * kPlace[k & 3];
        float left = 1.0 - share * hidden;
        float at = thin ? share * to : -log(left) / per_m;
        float weight = kWeight[k & 3] * fog_at(path, at) * exp(-of_fog(path, at)) / (thin ? 1.0 : left);
        all += weight;
        lit += weight * lit_share(index, eye_time.xyz + path.way * at);
    }
    return all > 0.0 ? lit / all : 1.0;
}

void add_even(uint index, AirPath path, float to, inout vec3 sum)
{
    Light light = lights[index];
    if (light.place.w != 0.0) return;
    vec3 even = light.intensity.rgb * phase(light, dot(light.place.xyz, path.way));
#ifdef SHADOWS
    if (index < uint(SHADOWS)) even *= share_in_fog(index, path, to);
#endif
    sum += even;
}

// Light that comes from everywhere or far away, as fog up to a distance scatters it: ambient and directional. `cluster`: that of
// the way's end.
vec3 even_light(AirPath path, float to, uint cluster)
{
    vec3 sum = flake_ambient();
    EACH_LIGHT_ON_THE_WAY(cluster, add_even(i, path, to, sum));
    return sum;
}

void add_glow(uint index, AirPath path, float to, inout vec3 sum)
{
    Light light = lights[index];
    if (light.place.w == 0.0) return;
#ifdef GLOW_GRIDS
    int grid = glow_grid(index);
    if (grid >= 0)
    {
        sum += light.intensity.rgb * glow_in_grid(grid, light, path.way, to);
        return;
    }
#endif
    sum += airlight_to(index, path, to);
}

// Glow of point and spot lamps on the way.
vec3 lamp_glow(AirPath path, float to, uint cluster)
{
    vec3 sum = vec3(0.0);
    EACH_LIGHT_ON_THE_WAY(cluster, add_glow(i, path, to, sum));
    return sum;
}
