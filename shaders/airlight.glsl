// SPDX-License-Identifier: MIT
// What lamps make of the air, as core/airlight.h has it: scattered once, eight Gauss-Legendre points over the angle at
// which the lamp sees the way.

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

float glow_at(Light light, AirPath path, float nearest, float least, float angle)
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
    return spot * spot * window * fog_at(path, at) * exp(-depth) * phase(light, -sine);
}

vec3 airlight(Light light, AirPath path, vec2 part)
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
        sum += kWeight[k] * (glow_at(light, path, nearest, least, middle - wide * kPlace[k]) +
                             glow_at(light, path, nearest, least, middle + wide * kPlace[k]));
    return light.intensity.rgb * (sum * wide / least);
}

vec3 airlight_to(Light light, AirPath path, float to)
{
    float enter = min(path.enters, to);
    float leave = min(path.leaves, to);
    vec3 sum = airlight(light, path, vec2(leave, to));
    if (enter > 0.0) sum += airlight(light, path, vec2(0.0, enter));
    if (leave > enter) sum += airlight(light, path, vec2(enter, leave));
    return sum;
}

void add_even(Light light, vec3 way, inout vec3 sum)
{
    if (light.place.w == 0.0) sum += light.intensity.rgb * phase(light, dot(light.place.xyz, way));
}

// Light that is the same along the whole way: ambient and directional. `cluster`: that of the way's end.
vec3 even_light(vec3 way, uint cluster)
{
    vec3 sum = flake_ambient();
    EACH_LIGHT_ON_THE_WAY(cluster, add_even(lights[i], way, sum));
    return sum;
}

void add_glow(Light light, AirPath path, float to, inout vec3 sum)
{
    if (light.place.w != 0.0) sum += airlight_to(light, path, to);
}

// Glow of point and spot lamps on the way.
vec3 lamp_glow(AirPath path, float to, uint cluster)
{
    vec3 sum = vec3(0.0);
    EACH_LIGHT_ON_THE_WAY(cluster, add_glow(lights[i], path, to, sum));
    return sum;
}
