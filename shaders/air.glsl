// SPDX-License-Identifier: MIT
// Snow-filled air, as core/air.h has it; gl/air_pass.h packs the block.
layout(std140, binding = 4) uniform Air
{
    vec4 layers;       // extinction (1/m): uniform, of the drift; 1 / height of the drift (1/m), its base (m)
    vec4 volume_low;   // of the drawn flakes (m); how many a cubic metre
    vec4 volume_high;  // m; 1: the report's law of fog
    vec4 shade_steps;  // log2 of the first depth, entries per log2, last entry (-1: none); visibility share of the report's law
    vec4 shade[128];   // what a flake hides: area (m2), its integral (m3); two entries each
};

float extinction_at(float height) { return layers.x + layers.y * exp(-max(height - layers.w, 0.0) * layers.z); }

float mean_drift(float from, float to)
{
    float a = (from - layers.w) * layers.z;
    float b = (to - layers.w) * layers.z;
    if (abs(b - a) < 1e-2) return exp(-max(0.5 * (a + b), 0.0));
    float low = min(a, 0.0) + (1.0 - exp(-max(a, 0.0)));
    float high = min(b, 0.0) + (1.0 - exp(-max(b, 0.0)));
    return (high - low) / (b - a);
}

float optical_depth(float from, float to, float length_m)
{
    return length_m * (layers.x + (layers.y > 0.0 ? layers.y * mean_drift(from, to) : 0.0));
}

// Area and integral of what a flake hides at a depth along the view.
vec2 shade_at(float depth)
{
    float last = shade_steps.z;
    if (last < 1.0) return vec2(0.0);
    float at = clamp((log2(max(depth, 1e-6)) - shade_steps.x) * shade_steps.y, 0.0, last);
    int low = int(min(at, last - 1.0));
    vec4 pair = shade[low >> 1];
    vec2 left = (low & 1) == 0 ? pair.xy : pair.zw;
    vec2 right = (low & 1) == 0 ? pair.zw : shade[(low >> 1) + 1].xy;
    return mix(left, right, at - float(low));
}

// A way from the eye: unit vector, its cosine to the view's forward, where it enters and leaves the flakes' volume.
struct AirPath
{
    vec3 way;
    float cosine;
    float enters, leaves;
};

void cut(float from, float along, float low, float high, inout AirPath path)
{
    if (abs(along) < 1e-9)
    {
        if (from < low || from > high) path.leaves = -1.0;
        return;
    }
    float a = (low - from) / along;
    float b = (high - from) / along;
    path.enters = max(path.enters, min(a, b));
    path.leaves = min(path.leaves, max(a, b));
}

AirPath air_path(vec3 way)
{
    AirPath path = AirPath(way, dot(way, forward_near.xyz), 0.0, 0.0);
    if (volume_low.w <= 0.0) return path;
    path.leaves = 1e30;
    cut(eye_time.x, way.x, volume_low.x, volume_high.x, path);
    cut(eye_time.y, way.y, volume_low.y, volume_high.y, path);
    cut(eye_time.z, way.z, volume_low.z, volume_high.z, path);
    path.leaves = max(path.enters, path.leaves);
    return path;
}

float of_fog(AirPath path, float to)
{
    float all = optical_depth(eye_time.z, eye_time.z + path.way.z * to, to);
    if (shade_steps.z < 1.0) return all;
    // Sprites are discs on the picture: they hide by depth.
    float first = shade_at(min(path.enters, to) * path.cosine).y;
    float last = shade_at(min(path.leaves, to) * path.cosine).y;
    return max(all - volume_low.w * (last - first), 0.0);
}

float fog_at(AirPath path, float at)
{
    float flakes = at > path.enters && at < path.leaves ? volume_low.w * shade_at(at * path.cosine).x * path.cosine : 0.0;
    return max(extinction_at(eye_time.z + path.way.z * at) - flakes, 0.0);
}

// Share that the air lets through up to a distance.
float clear_share(AirPath path, float to)
{
    if (volume_high.w == 0.0) return exp(-of_fog(path, to));
    float before = path.enters > 0.0 ? 0.0 : min(path.leaves, to);
    return clamp(shade_steps.w - (to - before) / 600.0, 0.0, 1.0);
}

// Share of a lamp's light that reaches a place.
float reaching(vec3 lamp, vec3 place)
{
    return volume_high.w == 0.0 ? exp(-optical_depth(lamp.z, place.z, length(lamp - place))) : 1.0;
}

// Share of a flake's opacity that is left where fog stands for the rest.
float kept_of_tiny(float diameter_px)
{
    return volume_high.w == 0.0 ? clamp(6.0 * diameter_px - 1.0, 0.0, 1.0) : 1.0;
}
