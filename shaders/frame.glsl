// SPDX-License-Identifier: MIT
// What all passes of one frame know; gl/frame_constants.h holds the same fields in the same order.
layout(std140, binding = 0) uniform Frame
{
    vec4 eye_time;          // m, s: display time
    vec4 right_tan;         // unit vector; tangent of half the horizontal field of view
    vec4 up_tan;            // unit vector; of the vertical one
    vec4 forward_near;      // unit vector; m
    vec4 ambient_far;       // radiance; m
    vec4 zenith;            // radiance, 0
    vec4 horizon_focal;     // radiance; px
    vec4 look;              // mean melted diameter (mm), flake_scale, flake_opacity, weight / scale^2
    vec4 sprite;            // largest radius (px), guard band: width and height of the picture over the viewport's, guard (px)
    uvec4 counts;           // lights, low word of the seed, crystal shapes, how many times flakes get the ambient light
    vec4 picture;           // width, height (px), extinction of the drawn flakes (1/m), 0
    vec4 mask_means[4];     // of the crystal shapes
};

// Ambient light of flakes and fog.
vec3 flake_ambient() { return ambient_far.rgb * float(counts.w); }

// Depth grows from 0 at the far plane to 1 at the near plane, so that floats are fine where it is needed.
float scene_z(float depth)
{
    float n = forward_near.w;
    float f = ambient_far.w;
    return n * f / (depth * (f - n) + n);
}

// Clip coordinates of a point given relative to the eye along right, up, forward; scale shrinks it into an enlarged viewport.
vec4 clip_from_view(vec3 v, vec2 scale)
{
    float n = forward_near.w;
    float f = ambient_far.w;
    return vec4(v.xy * scale / vec2(right_tan.w, up_tan.w), n * (f - v.z) / (f - n), v.z);
}

vec3 view_from_local(vec3 p)
{
    vec3 rel = p - eye_time.xyz;
    return vec3(dot(rel, right_tan.xyz), dot(rel, up_tan.xyz), dot(rel, forward_near.xyz));
}
