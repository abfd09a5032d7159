// SPDX-License-Identifier: MIT
// A flake's size, shape and turn from its id alone (docs/drawing.md; core/snow.h and core/philox.h hold the same in C++).
uint mix32(uint h)
{
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    return h ^ (h >> 16);
}

uint look_hash(uint base, uint k) { return mix32(base + k * 0x9E3779B9u); }
float look_unit(uint hash) { return (float(hash >> 8) + 0.5) * (1.0 / 16777216.0); }

const float kSnowDensity = 0.17;  // of Brandes' flakes, relative to water, times mm

// Diameter in metres from u in (0, 1); mean_melted_mm is 1 / Lambda.
float flake_diameter(float u, float mean_melted_mm)
{
    float melted = -log(u) * mean_melted_mm;
    return clamp(sqrt(melted * melted * melted / kSnowDensity), 0.2, 20.0) * 1e-3;
}
