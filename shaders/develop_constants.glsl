// SPDX-License-Identifier: MIT
// What the passes that develop a picture know of the frame, as flat varyings: see scene_constants.glsl.
flat VARYING float exposure;
flat VARYING vec4 bright;  // threshold, width of the knee, ceiling, where the knee begins
#ifdef TONE
flat VARYING vec3 tone;  // white, scale, offset
#endif
#ifdef BLOOM
flat VARYING vec3 mixing;  // weight, or 0 if nothing was bright; from pixels to coordinates of the spread light
#endif
