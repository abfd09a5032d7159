// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/air.h"
#include "core/flake.h"
#include "core/glow_grid.h"
#include "core/lamp_clusters.h"
#include "core/light.h"
#include "core/shadow.h"
#include "core/snow.h"
#include "core/view.h"

namespace spindrift
{

/// The crystal masks of all shapes, level by level: the texel (u, v) of shape s on level l is
/// texels[level_start[l] + (s << 2 k) + (v << k) + u], k = size_log2 - l. Three bytes behind the last are
/// readable.
struct CrystalTexels
{
    const std::uint8_t* texels = nullptr;
    std::int32_t level_start[8] = {};
    int size_log2 = 0;
    std::uint32_t shapes = 1;
    float means[16] = {};  ///< by shape
};

/// The air between the eye and the flakes.
struct SplatAir
{
    bool thick = false;  ///< false: clear, and the rest counts for nothing
    bool glows = false;  ///< point and spot lamps light it
    AirLayers<float> layers;
    FlakeVolume<float> volume;
};

/// How sprites that overlap make a pixel; docs/drawing.md "Blending".
enum class SplatBlending
{
    over,
    additive,
    weighted,
    stochastic,
};

inline constexpr int kMostSamples = 16;  ///< of a pixel, stochastic

/// What sprites are blended with, the same for a whole frame; docs/drawing.md says what it means.
struct SplatJob
{
    View view;
    float largest_px = 127;  ///< radius
    double time_s = 0;       ///< display time
    FlakeSizes sizes;
    float flake_scale = 1, flake_opacity = 1, real_flakes = 1;
    bool plain_discs = false;
    SplatBlending blending = SplatBlending::over;
    int samples = 8;             ///< stochastic: of a pixel, 1 to kMostSamples
    float extinction_per_m = 0;  ///< weighted: of the flakes
    Vec3f ambient{};
    SplatAir air;
    const Lamp<float>* lamps = nullptr;
    std::size_t lamp_count = 0;
    LampShadows shadows;    ///< of the first of them
    LampClusters clusters;  ///< which of the lamps count where
    GlowGrids glow;         ///< of lamps, where air.glows
    CrystalTexels crystals;
    FlakeView flakes{};
    float shutter_s = 0;                ///< how long it is open; 0: flakes are points in time
    const Vec3f* velocities = nullptr;  ///< by place in the draw list, m/s, local frame; with a shutter time
    const std::uint64_t* pairs = nullptr;  ///< of the draw list, in the order of blending
    std::size_t count = 0;
};

/// The picture that they are blended into, as GL keeps it: rows from the bottom.
struct SplatPicture
{
    int width_px = 0, height_px = 0;
    const float* depth = nullptr;   ///< 0 at the far plane, 1 at the near plane
    std::uint16_t* rgba = nullptr;  ///< half floats
    /// Display level of each half float that is not negative, in 1/256; null: no tone curve.
    const std::uint16_t* tone = nullptr;
    const std::uint8_t* noise = nullptr;  ///< by pixel, added before the level is cut to 8 bits; with tone
    std::uint8_t* display = nullptr;      ///< 8-bit RGBA, written if there is a tone curve
};

/// Blends flakes into a picture in memory.
class Splatter
{
  public:
    virtual ~Splatter() = default;
    virtual void splat(const SplatJob& job, const SplatPicture& picture) = 0;
};

}  // namespace spindrift
