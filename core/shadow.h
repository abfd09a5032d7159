// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/math.h"
#include "core/vec.h"

namespace spindrift
{

// What stands between a lamp and a place: the scene, as a map of the nearest depth that the lamp sees, and
// the drawn flakes, as their optical depth in slices. docs/drawing.md "Shadows". R: a pack of float where the
// processor blends; shaders/shadow.glsl mirrors it. Lengths in m, local frame.

inline constexpr std::size_t kMostShadows = 4;    ///< lamps of a scene that cast shadows
inline constexpr double kShadowNearest_m = 0.25;  ///< a spot's own housing, up to this depth, casts none
inline constexpr double kWidestShadow_deg = 80;   ///< half angle of a spot; a flat map holds little more
inline constexpr double kShadowOffset_texels =
    1.5;  ///< along the normal of a surface, before it is looked up

/// How a lamp sees a place: rows of a matrix over (x, y, z, 1).
struct LampLens
{
    float across[4] = {}, up[4] = {};  ///< over the width: 0 to 1 on the map
    float depth[4] = {};               ///< over the width: 0 to 1; of snow's slices not over the width
    float width[4] = {};               ///< 1 for parallel light, the depth in m for a spot
    float texel_m = 0;                 ///< edge of a texel where the width is 1
};

template <class R>
struct SeenByLamp
{
    R u, v, depth, width;
};

template <class R>
SPINDRIFT_HD R lens_row(const float (&row)[4], const Vec3<R>& place)
{
    return fma(place.x, R(row[0]), fma(place.y, R(row[1]), fma(place.z, R(row[2]), R(row[3]))));
}

/// u and v beyond 0 to 1 where the map does not reach; u = -1 behind a spot.
template <class R>
SPINDRIFT_HD SeenByLamp<R> seen_by(const LampLens& lens, const Vec3<R>& place)
{
    const R width = lens_row(lens.width, place);
    const auto behind = width <= R(0);
    const R per_width = R(1) / select(behind, R(1), width);
    return {select(behind, R(-1), lens_row(lens.across, place) * per_width),
            lens_row(lens.up, place) * per_width, lens_row(lens.depth, place), width};
}

/// The maps of the first lamps of a list, over memory that somebody else owns. Rows from the bottom.
struct LampShadows
{
    std::size_t lamps = 0;  ///< the first so many have maps
    int map_px = 0;
    const float* nearest = nullptr;  ///< depth, lamp by lamp
    LampLens map[kMostShadows];

    int snow_px = 0, snow_slices = 0;  ///< none: flakes dim no light
    const float* snow = nullptr;       ///< optical depth from the lamp to each end of a slice, lamp by lamp
    LampLens snow_map[kMostShadows];
    float snow_counts[kMostShadows] = {};  ///< 0: the air's extinction stands for these flakes already
};

namespace detail
{

/// The two texels about a place on one axis of a map, and the share of the second.
template <class R>
struct TexelPair
{
    R first, second, share;

    SPINDRIFT_HD TexelPair(const R& at, int px)
    {
        const R texel = at * R(static_cast<float>(px)) - R(0.5F);
        const R low = floor(texel), last = R(static_cast<float>(px - 1));
        share = texel - low;
        first = clamp(low, R(0), last);
        second = clamp(low + R(1), R(0), last);
    }
};

template <class R>
SPINDRIFT_HD R mixed(const R& a, const R& b, const R& share)
{
    return a + (b - a) * share;
}

}  // namespace detail

/// Share of a lamp's light that the scene lets through to a place: compared with the four nearest texels, and
/// the answers interpolated. 1 outside of the map.
template <class R>
SPINDRIFT_HD R unhidden_share(const LampShadows& shadows, std::size_t lamp, const Vec3<R>& place)
{
    const SeenByLamp<R> at = seen_by(shadows.map[lamp], place);
    const auto inside = at.u >= R(0) && at.u <= R(1) && at.v >= R(0) && at.v <= R(1);
    if (none(inside)) return R(1);
    const int px = shadows.map_px;
    const float* nearest =
        shadows.nearest + lamp * static_cast<std::size_t>(px) * static_cast<std::size_t>(px);
    const R u = select(inside, at.u, R(0)), v = select(inside, at.v, R(0));
    const R depth = min(at.depth / select(inside, at.width, R(1)), R(1));
    const detail::TexelPair<R> x(u, px), y(v, px);
    const R row = R(static_cast<float>(px));  // indices are below 2^24: exact
    const auto lit = [&](const R& column, const R& line)
    { return select(depth <= gather(nearest, truncate_to_int(line * row + column)), R(1), R(0)); };
    const R low = detail::mixed(lit(x.first, y.first), lit(x.second, y.first), x.share);
    const R high = detail::mixed(lit(x.first, y.second), lit(x.second, y.second), x.share);
    return select(inside, detail::mixed(low, high, y.share), R(1));
}

/// Optical depth of the drawn flakes between a lamp and a place, linear within a slice. 0 outside of the map.
template <class R>
SPINDRIFT_HD R snow_depth(const LampShadows& shadows, std::size_t lamp, const Vec3<R>& place)
{
    const SeenByLamp<R> at = seen_by(shadows.snow_map[lamp], place);
    const auto inside = at.u >= R(0) && at.u <= R(1) && at.v >= R(0) && at.v <= R(1) && at.depth > R(0);
    if (none(inside)) return R(0);
    const int px = shadows.snow_px, slices = shadows.snow_slices;
    const std::size_t texels = static_cast<std::size_t>(px) * static_cast<std::size_t>(px);
    const float* depths = shadows.snow + lamp * static_cast<std::size_t>(slices + 1) * texels;
    const detail::TexelPair<R> x(select(inside, at.u, R(0)), px), y(select(inside, at.v, R(0)), px);
    const R along = clamp(select(inside, at.depth, R(0)), R(0), R(1)) * R(static_cast<float>(slices));
    const R slice = min(floor(along), R(static_cast<float>(slices - 1)));
    const R row = R(static_cast<float>(px)), layer = R(static_cast<float>(texels));
    const auto depth = [&](const R& column, const R& line)
    {
        const R first = slice * layer + line * row + column;
        return detail::mixed(gather(depths, truncate_to_int(first)),
                             gather(depths, truncate_to_int(first + layer)), along - slice);
    };
    const R low = detail::mixed(depth(x.first, y.first), depth(x.second, y.first), x.share);
    const R high = detail::mixed(depth(x.first, y.second), depth(x.second, y.second), x.share);
    return select(inside, detail::mixed(low, high, y.share), R(0));
}

/// Share of a lamp's light that reaches a place past scene and flakes; 1 for lamps without a map.
template <class R>
SPINDRIFT_HD R lit_share(const LampShadows& shadows, std::size_t lamp, const Vec3<R>& place)
{
    if (lamp >= shadows.lamps) return R(1);
    R share = shadows.map_px > 0 ? unhidden_share(shadows, lamp, place) : R(1);
    if (shadows.snow_slices > 0 && shadows.snow_counts[lamp] > 0)
        share = share * exp(-snow_depth(shadows, lamp, place));
    return share;
}

}  // namespace spindrift
