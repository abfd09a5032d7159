// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/advect_job.h"
#include "core/depth_key.h"
#include "core/encounter.h"
#include "core/flake.h"
#include "core/snow.h"
#include "core/splatter.h"

namespace spindrift::cpu
{

/// A flake placed, sized and lit on the picture.
struct alignas(64) PlacedSprite
{
    float x_px, y_px;  ///< centre, from the lower left corner of the picture
    float r_px;
    float z_m;
    float opacity;               ///< at the centre, before the weight
    float fade_per_m;            ///< 1 / length over which it fades into the scene
    float red, green, blue;      ///< radiance; of a detailed sprite the lamps' part alone
    float right, up, to_viewer;  ///< unit vector to the lamps; only detailed sprites have it and the rest
    float cosine, sine;          ///< of the angle
    std::uint32_t hash;          ///< random bits; modulo their number the shape of its crystal
    std::uint32_t level;         ///< of the mask, plus 1; 0: not a detailed sprite
};

/// The way of a sprite while the shutter is open, in radii (core/streak.h).
struct PlacedStreak
{
    float along_x, along_y, half, even;
};

/// Tiles that a sprite touches, [first, last] each way; none if first > last.
struct TileBox
{
    std::int16_t first_x, first_y, last_x, last_y;
};

/// Edge of a tile of the picture that one task blends: its planes stay in the first cache.
inline constexpr int kTilePx = 32;

/// The kernels compiled for one instruction set. Each works on the slots [first, last) on one thread; `first`
/// is a multiple of 16. The translation units behind it include neither threads nor containers, so that no
/// function of theirs that the rest of the program shares is ever compiled for a processor that is not there.
struct KernelTable
{
    void (*advect)(const AdvectJob& job, std::size_t first, std::size_t last, EncounterTally& tally);

    /// Writes key << 32 | slot of the visible flakes to `out` (room for last - first), in slot order; returns
    /// how many.
    std::size_t (*list_visible)(const Frustum& frustum, const FlakeView& flakes, std::size_t first,
                                std::size_t last, std::uint64_t* out);

    /// Places the flakes [first, last) of the job's draw list.
    /// `ambients`: the light of detailed sprites that the imposter does not shade; only in thick air.
    /// `streaks`: only with a shutter time.
    void (*place_sprites)(const SplatJob& job, std::size_t first, std::size_t last, PlacedSprite* sprites,
                          TileBox* boxes, Vec3f* ambients, PlacedStreak* streaks);

    /// Blends sprites[which[0]], sprites[which[1]] … into the tile whose lower left pixel is (x0, y0), and
    /// develops it.
    void (*blend_tile)(const SplatJob& job, const SplatPicture& picture, int x0, int y0,
                       const PlacedSprite* sprites, const Vec3f* ambients, const PlacedStreak* streaks,
                       const std::uint32_t* which, std::size_t count);
};

extern const KernelTable kScalarKernels;
extern const KernelTable kScalarFmaKernels;
extern const KernelTable kAvx2Kernels;
extern const KernelTable kAvx512Kernels;

}  // namespace spindrift::cpu
