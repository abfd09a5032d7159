// SPDX-License-Identifier: MIT
// A flake's profile, crystal and imposter over the pixels of its point.
#include "frame.glsl"
layout(binding = 0) uniform sampler2D scene_depth;
layout(binding = 1) uniform sampler2DArray masks;

flat in vec4 glow;
#ifdef LARGE
flat in vec4 lamp;
flat in vec4 shape;
flat in vec3 fade;
flat in vec3 even;
#elif defined(WEIGHTED)
flat in float kept;
#endif
#ifdef SHARED
flat in float share;
layout(location = 0) out vec4 sum;  // radiance and weight
layout(location = 1) out float covered;

void put(vec3 radiance, float alpha)
{
    sum = vec4(radiance, 1.0) * (alpha * share);
    covered = alpha;
}
#elif defined(SAMPLED)
flat in uint random;
layout(location = 1) uniform ivec3 samples;  // the first of this pass, how many it has, how many there are in all
layout(location = 0) out vec4 colour;

// core/sprite.h
float grain()
{
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    uint h = random + pixel.x * 0x9E3779B9u + pixel.y * 0x85EBCA6Bu;
    h = (h ^ (h >> 16)) * 0x7FEB352Du;
    h = (h ^ (h >> 15)) * 0x846CA68Bu;
    h ^= h >> 16;
    return (float(h >> 8) + 0.5) * (1.0 / 16777216.0);
}

void put(vec3 radiance, float alpha)
{
    float first = grain();
    int covered = 0;
    for (int s = 0; s < samples.y; ++s)
        if (fract(first + float(samples.x + s) / float(samples.z)) < alpha) covered |= 1 << s;
    gl_SampleMask[0] = covered;
    colour = vec4(radiance, 1.0);
}
#else
layout(location = 0) out vec4 colour;

void put(vec3 radiance, float alpha) { colour = vec4(radiance * alpha, alpha); }
#endif

#if defined(SAMPLED) || defined(STREAK)
flat in vec3 disc;
#endif
#ifdef STREAK
flat in vec4 streak;
#endif

// exp(-rho^2 / (2 0.45^2)) as a power of two.
const float kProfile = -3.5622594;

float profile(float rho2)
{
#ifdef POINT_SPRITE
    return rho2 <= 1.0 ? 1.0 : 0.0;
#else
    return rho2 <= 1.0 ? exp2(kProfile * rho2) : 0.0;
#endif
}

// One drawn flake stands for several real ones.
float weighted(float opacity)
{
#ifdef WEIGHTED
    return 1.0 - exp2(log2(1.0 - min(opacity, 0.9999)) * look.w);
#else
    return min(opacity, 0.9999);
#endif
}

#ifdef STREAK
// Integral of the profile along a line, core/streak.h: 14 terms of its series.
float profile_integral(float x)
{
    const float k = 2.4691358;
    float x2 = x * x;
    float term = x;
    float sum = x;
    for (int n = 1; n < 14; ++n)
    {
        term *= -k * x2 / float(n);
        sum += term / float(2 * n + 1);
    }
    return sum;
}

// Mean of the profile over the way.
float streak_profile(vec2 p)
{
    float s = dot(p, streak.xy);
    float q = p.y * streak.x - p.x * streak.y;
    float q2 = min(q * q, 1.0);
    float chord = sqrt(1.0 - q2);
    float from = clamp(s - streak.z, -chord, chord);
    float to = clamp(s + streak.z, -chord, chord);
    float disc_share = (to - from) * 0.5 / streak.z;
#ifdef POINT_SPRITE
    return disc_share;
#else
    float gauss = exp2(kProfile * q2) * (profile_integral(to) - profile_integral(from)) * 0.5 / streak.z;
    return max(mix(gauss, disc_share, streak.w), 0.0);
#endif
}
#endif

#ifdef LARGE
float imposter(vec2 p, float rho2)
{
    vec3 n = vec3(p, sqrt(max(1.0 - rho2, 0.0)));
    return mix(1.0, (1.0 + 0.5 * dot(n, lamp.xyz)) / (1.0 + lamp.z / 3.0), lamp.w);
}

float crystal(vec2 p)
{
    vec2 uv = vec2(shape.x * p.x + shape.y * p.y, shape.x * p.y - shape.y * p.x);
    float m = textureLod(masks, vec3(uv * 0.5 + 0.5, shape.w), shape.z).r;
    return mix(fade.z, m, lamp.w);
}

float soft_edge()
{
    if (fade.y < 0.0) return fade.x;
    float gap = scene_z(texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).r) - fade.x;
    return clamp(gap * fade.y, 0.0, 1.0);
}
#endif

// Alpha before the scene cuts in. mask: of the crystal here; mean: of all of it.
float covering(vec2 p, float rho2, float mask, float mean)
{
#ifdef STREAK
    if (streak.z > 0.0) return min(weighted(glow.a * mean) * streak_profile(p) * (mask / mean), 1.0);
#endif
    return weighted(glow.a * profile(rho2) * mask);
}

void main()
{
#if defined(SAMPLED) || defined(STREAK)
    vec2 p = (gl_FragCoord.xy - disc.xy) / disc.z;
#else
    vec2 p = vec2(2.0, -2.0) * gl_PointCoord + vec2(-1.0, 1.0);
#endif
    float rho2 = dot(p, p);
#ifdef OPAQUE
    if (rho2 > 1.0) discard;
    colour = vec4(glow.rgb, 1.0);
#elif defined(LARGE)
    vec3 lit = glow.rgb;
    float mask = 1.0;
#ifndef POINT_SPRITE
    mask = crystal(p);
    lit *= imposter(p, rho2);
#endif
    float alpha = covering(p, rho2, mask, fade.z) * soft_edge();
    put(min(even + lit, 6e4), alpha);
#else
    float alpha = covering(p, rho2, 1.0, 1.0);
#ifdef WEIGHTED
    alpha *= kept;
#endif
    put(glow.rgb, alpha);
#endif
}
