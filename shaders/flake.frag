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
layout(location = 0) out vec4 colour;

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

void main()
{
    vec2 p = vec2(2.0, -2.0) * gl_PointCoord + vec2(-1.0, 1.0);
    float rho2 = dot(p, p);
#ifdef OPAQUE
    if (rho2 > 1.0) discard;
    colour = vec4(glow.rgb, 1.0);
#elif defined(LARGE)
    float opacity = glow.a * profile(rho2);
    vec3 lit = glow.rgb;
#ifndef POINT_SPRITE
    opacity *= crystal(p);
    lit *= imposter(p, rho2);
#endif
    float alpha = weighted(opacity) * soft_edge();
    colour = vec4(min(even + lit, 6e4) * alpha, alpha);
#else
    float alpha = weighted(glow.a * profile(rho2));
#ifdef WEIGHTED
    alpha *= kept;
#endif
    colour = vec4(glow.rgb * alpha, alpha);
#endif
}
