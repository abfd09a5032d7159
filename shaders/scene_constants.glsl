// SPDX-License-Identifier: MIT
// What is constant over a draw reaches the fragments as flat varyings: software GL reads one in a single instruction, a
// uniform in about eight.
#include "frame.glsl"
#include "lights.glsl"
#if defined(LIGHTS) && LIGHTS > 0 && LIGHTS <= 4
#define FLAT_LIGHTS  // more would not fit
#endif
VARYING vec3 place;   // from the eye
VARYING vec3 normal;
flat VARYING vec3 albedo;
flat VARYING vec3 emission;
flat VARYING vec3 ambient;
#ifdef SHINY
flat VARYING vec4 gloss;  // share that is mirrored times the height of the lobe, exponent
flat VARYING vec3 matt;   // albedo of the rest
#endif
#ifdef FLAT_LIGHTS
flat VARYING Light lamps[LIGHTS];  // their places from the eye
#endif
