// SPDX-License-Identifier: MIT
// The lights that are on at the display time of the frame; gl/active_lights.h packs them.
#ifdef AIR
#include "air.glsl"
#endif
struct Light
{
    vec4 place;      // point, spot: position (m), 1; directional: the unit vector towards the light, 0
    vec4 direction;  // the way it travels; factor of the spot term
    vec4 intensity;  // W/sr or W/m2; asymmetry g (Schlick: k)
    vec4 limits;     // offset of the spot term, 1 / range, share of the second lobe (-1: Schlick), its g
};
// Up to eight lights are read as uniforms by constant index, which software GL does an order faster; more as a buffer.
#ifdef LIGHTS
const uint kLightCount = uint(LIGHTS);
layout(std140, binding = 1) uniform FewLights { Light lights[8]; };
#else
#define kLightCount counts.x
layout(std430, binding = 5) readonly buffer Lights { Light lights[]; };
// Which of them count where; core/lamp_clusters.h has it, gl/cluster_lamps.h fills it.
#ifdef FILLS_GRIDS
layout(std430, binding = 7) buffer LampClusters
#else
layout(std430, binding = 7) readonly buffer LampClusters
#endif
{
    vec4 cluster_grid;       // left and lower end (px), columns and rows a px
    vec2 cluster_depth;      // log2 of the depth (m) at which slice 0 ends, slices per log2
    uint cluster_words;      // of a cluster
    uint cluster_ways;       // words before the bits of the ways to the clusters
    uint cluster_bits[];     // and behind them the grids of glow (glow_grid.glsl)
};
const vec3 kClusters = vec3(24.0, 16.0, 20.0);  // columns, rows, slices
#endif

// Where in the bits those of the cluster begin that holds a place: px from the lower left corner, depth in m.
uint cluster_at(vec2 px, float z)
{
#ifdef LIGHTS
    return 0u;
#else
    float slice = (log2(max(z, 1e-6)) - cluster_depth.x) * cluster_depth.y + 1.0;
    uvec3 at = uvec3(clamp(vec3((px - cluster_grid.xy) * cluster_grid.zw, slice), vec3(0.0), kClusters - 1.0));
    return ((at.z * uint(kClusters.y) + at.y) * uint(kClusters.x) + at.x) * cluster_words;
#endif
}

// Runs `body`, which may use i, for each light that may count in a cluster: lamps that reach into it, or with `ways` those
// that reach the way there from the eye. Few lights are all run, by constant index.
#ifdef LIGHTS
#define EACH_LIGHT(cluster, body) \
    for (uint i = 0u; i < kLightCount; ++i) body
#define EACH_LIGHT_ON_THE_WAY(cluster, body) EACH_LIGHT(cluster, body)
#else
#define EACH_LIGHT(cluster, body)                                                                     \
    for (uint word = 0u; word < cluster_words; ++word)                                                \
        for (uint left = cluster_bits[(cluster) + word]; left != 0u; left &= left - 1u)               \
        {                                                                                             \
            uint i = 32u * word + uint(findLSB(left));                                                \
            body;                                                                                     \
        }
#define EACH_LIGHT_ON_THE_WAY(cluster, body) EACH_LIGHT(cluster_ways + (cluster), body)
#endif

// The same light for places that are told from the eye.
Light seen_from(Light light, vec3 eye)
{
    light.place.xyz -= eye * light.place.w;
    return light;
}

const float kNearestLight = 0.05;  // m

#ifdef SHADOWS
#include "shadow.glsl"
#else
float lit_share(uint light, vec3 p) { return 1.0; }
#endif

// Irradiance of light i at p on a surface that faces it; to_light is the unit vector towards it.
vec3 irradiance(Light light, vec3 p, out vec3 to_light)
{
    vec3 way = light.place.xyz - p * light.place.w;
    float d2 = max(dot(way, way), 1e-12);
    float per_m = inversesqrt(d2);
    to_light = way * per_m;
    float spot = clamp(light.limits.x - dot(to_light, light.direction.xyz) * light.direction.w, 0.0, 1.0);
    float u2 = d2 * light.limits.y * light.limits.y;
    float window = max(1.0 - u2 * u2, 0.0);
    float near = light.place.w > 0.0 ? min(per_m, 1.0 / kNearestLight) : 1.0;
    return light.intensity.rgb * (spot * spot * window * near * near);
}

// Henyey-Greenstein (Astrophys. J. 93, 1941) in the form that is stable near |g| = 1 for both signs, as core/phase.h has it;
// mu = 1: straight on.
float henyey_greenstein(float g, float mu)
{
    float size = abs(g);
    float rest = 1.0 - size;
    float d = max(rest * rest + 2.0 * size * (1.0 - (g < 0.0 ? -mu : mu)), 1e-10);
    return rest * (1.0 + size) / (12.566370614 * d * sqrt(d));
}

// Schlick's stand-in (Computer Graphics Forum 12, 1993).
float schlick(float k, float mu)
{
    float away = 1.0 - k * mu;
    return (1.0 - k * k) / (12.566370614 * away * away);
}

float phase(Light light, float mu)
{
    if (light.limits.z < 0.0) return schlick(light.intensity.w, mu);
    float ahead = henyey_greenstein(light.intensity.w, mu);
    if (light.limits.z == 0.0) return ahead;
    return mix(ahead, henyey_greenstein(light.limits.w, mu), light.limits.z);
}
