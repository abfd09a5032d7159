// SPDX-License-Identifier: MIT
// One flake: pulled from the simulation's own arrays by the sorted list, sized, lit and placed.
// LARGE: flakes that may be 3 px or more in radius; they carry what the crystal and the imposter need.
#include "frame.glsl"
#include "flake_look.glsl"
#include "lights.glsl"
#ifdef AIR
#include "airlight.glsl"
#endif
layout(std430, binding = 0) readonly buffer XArray { float x_m[]; };
layout(std430, binding = 1) readonly buffer YArray { float y_m[]; };
layout(std430, binding = 2) readonly buffer ZArray { float z_m[]; };
layout(std430, binding = 3) readonly buffer IdArray { uint ids[]; };
layout(std430, binding = 4) readonly buffer DrawList { uvec2 draw_list[]; };  // slot, depth key
layout(binding = 0) uniform sampler2D scene_depth;
layout(binding = 2) uniform sampler2D depth_tiles;  // farthest depth in 8x8 pixels
layout(location = 0) uniform int has_scene;  // scene_depth and depth_tiles hold something

flat out vec4 glow;  // radiance (LARGE: of the lights alone), opacity at the centre
#ifdef LARGE
flat out vec4 lamp;   // unit vector towards the lights (right, up, viewer), share of crystal and imposter
flat out vec4 shape;  // cosine and sine of the angle, mip level, layer
flat out vec3 fade;   // depth (m), 1 / length of the fade (1/m) or -1: .x is the share that is left; mean of the mask
flat out vec3 even;   // radiance that the imposter does not shade
#elif defined(WEIGHTED)
flat out float kept;  // share of alpha that is left where the flake cuts into the scene
#endif

#ifdef SHARED
flat out float share;  // in what all flakes of a pixel cover
#elif defined(SAMPLED)
flat out uint random;  // bits of the flake's own
#endif
#if defined(SAMPLED) || defined(STREAK)
flat out vec3 disc;  // centre and radius, px from the lower left corner of the picture
#endif
#ifdef STREAK
layout(std430, binding = 6) readonly buffer Motion { float velocities[]; };  // by place in the draw list, m/s
layout(location = 2) uniform float shutter_s;
flat out vec4 streak;    // unit vector along the way, half of it in radii (0: none), share of the plain disc
#endif

const float kSmallest = 0.75;  // px, radius
const float kLargestRadiance = 6e4;

bool finite(float v) { return (floatBitsToUint(v) & 0x7f800000u) != 0x7f800000u; }

void add_scattered(uint index, vec3 p, vec3 to_eye, inout vec3 sum, inout vec3 towards)
{
    Light light = lights[index];
    vec3 to_light;
    vec3 e = irradiance(light, p, to_light);
#ifdef AIR
    if (light.place.w != 0.0) e *= reaching(light.place.xyz, p);
#endif
    e *= lit_share(index, p);
    float mu = clamp(-dot(to_light, to_eye), -1.0, 1.0);
    sum += e * phase(light, mu);
    towards += to_light * dot(e, vec3(0.2126, 0.7152, 0.0722));
}

vec3 scattered(vec3 p, vec3 to_eye, uint cluster, out vec3 towards)
{
    vec3 sum = vec3(0.0);
    towards = vec3(0.0);
    EACH_LIGHT(cluster, add_scattered(i, p, to_eye, sum, towards));
    return sum;
}

// Where it is on the picture, px from the lower left corner.
vec2 centre_px(vec4 clip) { return (clip.xy / (clip.w * sprite.yz) * 0.5 + 0.5) * picture.xy; }

// Share of the flake that is left where it cuts into the scene, looked up once at its centre. Behind the scene the
// depth test decides pixel by pixel.
float soft_edge(vec4 clip, float z, float length_m)
{
    if (has_scene == 0) return 1.0;
    ivec2 pixel = clamp(ivec2(floor(centre_px(clip))), ivec2(0), ivec2(picture.xy) - 1);
    float gap = scene_z(texelFetch(scene_depth, pixel, 0).r) - z;
    return gap > 0.0 ? min(gap / length_m, 1.0) : 1.0;
}

#ifndef LARGE
// Whether the scene hides all of a sprite that is less than 7 px across, so that it need not be rasterised.
bool hidden(vec4 clip, float drawn)
{
    if (has_scene == 0) return false;
    vec2 centre = centre_px(clip);
    // The four tiles round the lower left corner of the sprite's box hold all of it.
    vec2 tile = floor((centre - drawn - 0.5) * 0.125) + 1.0;
    vec4 farthest = textureGather(depth_tiles, tile / vec2(textureSize(depth_tiles, 0)));
    return clip.z < clip.w * min(min(farthest.x, farthest.y), min(farthest.z, farthest.w));
}
#endif

#ifdef AIR
// Light as it reaches the eye: dimmed by the air between, and with the glow of that air. Where light is only added, that
// glow is in the picture already.
void see_through_air(vec3 way, float distance_m, uint cluster, inout vec3 lit, inout vec3 ambient)
{
    if (volume_high.w != 0.0) return;
    AirPath path = air_path(way);
    float clear = clear_share(path, distance_m);
    lit *= clear;
    ambient *= clear;
#ifndef ADDITIVE
    ambient += even_light(path, distance_m, cluster) * (1.0 - clear);
#ifdef GLOW
    ambient += lamp_glow(path, distance_m, cluster);
#endif
#endif
}
#endif

#ifdef STREAK
// core/streak.h; its share of the plain disc comes with the opacity.
vec4 streak_of(vec3 v, float drawn)
{
    vec3 velocity = vec3(velocities[3 * gl_VertexID], velocities[3 * gl_VertexID + 1], velocities[3 * gl_VertexID + 2]);
    vec3 seen = vec3(dot(velocity, right_tan.xyz), dot(velocity, up_tan.xyz), dot(velocity, forward_near.xyz));
    vec2 way = (seen.xy - v.xy * (seen.z / v.z)) * (0.5 * shutter_s * horizon_focal.w / v.z);
    float px = length(way);
    float half_way = min(px, sprite.x - drawn) / drawn;
    return vec4(px > 1e-9 ? way / px : vec2(1.0, 0.0), half_way > 0.05 ? half_way : 0.0, 0.0);
}

float weighted(float opacity) { return 1.0 - exp2(log2(1.0 - min(opacity, 0.9999)) * look.w); }

float even_share(float opacity)
{
    const vec4 place = vec4(0.06943184, 0.33000948, 0.66999052, 0.93056816);
    const vec4 weight = vec4(0.17392742, 0.32607258, 0.32607258, 0.17392742);
    const float gauss = 0.37071351;
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += weight[i] * weighted(opacity * exp2(-3.5622594 * place[i]));
    return (sum / max(weighted(opacity), 1e-12) - gauss) / (1.0 - gauss);
}
#endif

void hide()
{
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
}

void main()
{
    uint slot = draw_list[gl_VertexID].x;
    vec3 p = vec3(x_m[slot], y_m[slot], z_m[slot]);
    uint base = mix32(ids[slot] ^ counts.y);
    vec3 v = view_from_local(p);

    float radius_m = 0.5 * flake_diameter(look_unit(look_hash(base, 0u)), look.x) * look.y;
    float z = v.z;
    float near = forward_near.w;
    if (!finite(p.x + p.y + p.z) || !(z > near) || !(z < ambient_far.w))
    {
        hide();
        return;
    }
    vec4 clip = clip_from_view(v, sprite.yz);
    float r = radius_m * horizon_focal.w / z;
    float drawn = clamp(r, kSmallest, sprite.x);
#ifndef LARGE
#ifndef STREAK
    if (drawn < 3.5 && hidden(clip, drawn))
    {
        hide();
        return;
    }
#endif
#endif
    gl_Position = clip;
    gl_PointSize = 2.0 * drawn;
#ifdef SHARED
    share = exp2(max(picture.z * z * -1.44269504, -30.0));
#elif defined(SAMPLED)
    // With samples a point covers a pixel only where it covers them: all pixels whose centre is in the sprite need a rim.
    gl_PointSize = min(gl_PointSize + 2.0, 255.0);
    random = look_hash(base, 1u);
#endif
#if defined(SAMPLED) || defined(STREAK)
    disc = vec3(centre_px(clip), drawn);
#endif
#ifdef STREAK
    streak = streak_of(v, drawn);
    // A sprite with its streak, and a rim for samples.
    gl_PointSize = min(2.0 * drawn * (1.0 + streak.z) + 2.0, 255.0);
#endif

    vec3 towards;
    vec3 to_eye = (eye_time.xyz - p) * inversesqrt(dot(v, v));
    uint cluster = cluster_at(centre_px(clip), z);
    vec3 lit = scattered(p, to_eye, cluster, towards);
    vec3 ambient = flake_ambient();
#ifdef AIR
    see_through_air(-to_eye, length(v), cluster, lit, ambient);
#endif
#ifdef OPAQUE
    glow = vec4(min(ambient + lit, kLargestRadiance), 1.0);
#else
    float small = min(r / kSmallest, 1.0);
#ifdef AIR
    small *= sqrt(kept_of_tiny(2.0 * r));
#endif
    float opacity = small * small * clamp((z - near) / (3.0 * near), 0.0, 1.0);
    float length_m = max(radius_m, 0.05);
    float mean = 1.0;
    uint which = look_hash(base, 1u) % counts.z;
#ifndef POINT_SPRITE
    opacity *= look.z;
    mean = mask_means[which >> 2][which & 3u];
#endif
#ifdef STREAK
    streak.w = even_share(opacity * mean);
#endif
#ifdef LARGE
    float turn = look_unit(look_hash(base, 2u)) + (look_unit(look_hash(base, 3u)) - 0.5) * eye_time.w;
    float angle = 6.283185307 * fract(turn);
    float strength = length(towards);
    vec3 l = strength > 0.0 ? towards / strength : vec3(0.0);
    glow = vec4(lit, opacity);
    even = ambient;
    lamp = vec4(dot(l, right_tan.xyz), dot(l, up_tan.xyz), -dot(l, forward_near.xyz), clamp((r - 3.0) / 3.0, 0.0, 1.0));
#ifdef STREAK
    lamp.w *= max(1.0 - 2.0 * streak.z, 0.0);
#endif
    shape = vec4(cos(angle), sin(angle), floor(max(log2(64.0 / drawn), 0.0) + 0.5), float(which));
    fade = r < 3.0 || has_scene == 0 ? vec3(soft_edge(clip, z, length_m), -1.0, mean) : vec3(z, 1.0 / length_m, mean);
#else
    glow = vec4(min(ambient + lit, kLargestRadiance), opacity * mean);
#ifdef WEIGHTED
    kept = soft_edge(clip, z, length_m);
#else
    glow.a *= soft_edge(clip, z, length_m);
#endif
#endif
#endif
}
