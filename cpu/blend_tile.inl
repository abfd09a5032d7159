// SPDX-License-Identifier: MIT
// Part of kernels.inl: sprites are blended into one tile of the picture, a pack of pixels of a row at a time.

#include "core/sprite.h"
#include "cpu/half_pixels.h"

namespace spindrift::cpu
{

namespace
{

/// So many sprites ahead of the one that is blended, the next ones are called into the cache.
constexpr std::size_t kAhead = 12;

/// A tile in float. A pack that starts inside a row may end in the next 16 columns: they are spare.
struct TilePlanes
{
    static constexpr int kStride = kTilePx + 16;
    alignas(64) float z[kTilePx * kStride];
    alignas(64) float red[kTilePx * kStride];
    alignas(64) float green[kTilePx * kStride];
    alignas(64) float blue[kTilePx * kStride];
};

/// The pixels of a tile that lie in the picture.
struct TilePlace
{
    const SplatPicture& picture;
    int x0, y0, columns, rows;

    SPINDRIFT_HD std::size_t offset(int row) const
    {
        return static_cast<std::size_t>(y0 + row) * static_cast<std::size_t>(picture.width_px) +
               static_cast<std::size_t>(x0);
    }
};

/// Metres along the view; infinity where nothing was drawn.
SPINDRIFT_HD Real scene_z(const Real& depth, const View& view)
{
    const Real n(view.near_m), f(view.far_m);
    return select(depth > Real(0), n * f / fma(depth, f - n, n), infinity<Real>());
}

SPINDRIFT_HD void load_row(const TilePlace& place, const View& view, int row, TilePlanes& planes)
{
    const std::uint16_t* rgba = place.picture.rgba + place.offset(row) * 4;
    const float* depth = place.picture.depth + place.offset(row);
    std::uint16_t part_rgba[kTilePx * 4] = {};
    float part_depth[kTilePx] = {};
    if (place.columns < kTilePx)
    {
        __builtin_memcpy(part_rgba, rgba, static_cast<std::size_t>(place.columns) * 8);
        __builtin_memcpy(part_depth, depth, static_cast<std::size_t>(place.columns) * 4);
        rgba = part_rgba;
        depth = part_depth;
    }
    const int at = row * TilePlanes::kStride;
    for (int x = 0; x < kTilePx; x += static_cast<int>(kWidth))
    {
        Real red, green, blue;
        load_pixels(rgba + 4 * x, red, green, blue);
        store(planes.red + at + x, red);
        store(planes.green + at + x, green);
        store(planes.blue + at + x, blue);
        store(planes.z + at + x, scene_z(load<Real>(depth + x), view));
    }
    for (float* plane : {planes.z, planes.red, planes.green, planes.blue})
        __builtin_memset(plane + at + kTilePx, 0, 16 * sizeof(float));
}

SPINDRIFT_HD void store_row(const TilePlace& place, int row, const TilePlanes& planes)
{
    std::uint16_t* rgba = place.picture.rgba + place.offset(row) * 4;
    std::uint16_t part[kTilePx * 4];
    std::uint16_t* to = place.columns < kTilePx ? part : rgba;
    const int at = row * TilePlanes::kStride;
    for (int x = 0; x < kTilePx; x += static_cast<int>(kWidth))
        store_pixels(to + 4 * x, load<Real>(planes.red + at + x), load<Real>(planes.green + at + x),
                     load<Real>(planes.blue + at + x));
    if (to == part) __builtin_memcpy(rgba, part, static_cast<std::size_t>(place.columns) * 8);
}

SPINDRIFT_HD void develop_row(const TilePlace& place, int row)
{
    const std::uint16_t* rgba = place.picture.rgba + place.offset(row) * 4;
    std::uint8_t* out = place.picture.display + place.offset(row) * 4;
    const std::uint16_t* tone = place.picture.tone;
    const std::uint8_t* noise = place.picture.noise + place.offset(row);
    const auto level = [&](std::uint16_t half, std::uint32_t dither)
    { return (tone[half & 0x7FFFU] + dither) >> 8; };
    for (int x = 0; x < place.columns; ++x)
    {
        const std::uint32_t red = level(rgba[4 * x], noise[x]), green = level(rgba[4 * x + 1], noise[x]),
                            blue = level(rgba[4 * x + 2], noise[x]);
        const std::uint32_t pixel = red | green << 8 | blue << 16 | 0xFF000000U;
        __builtin_memcpy(out + 4 * x, &pixel, 4);
    }
}

/// Bilinear sample of a sprite's mask at (u, v) of [-1, 1]², edges clamped.
SPINDRIFT_HD Real sample_mask(const CrystalTexels& crystals, const PlacedSprite& s, const Real& u,
                              const Real& v)
{
    using Int = IntOf<Real>;
    const int size_log2 = crystals.size_log2 - static_cast<int>(s.level - 1);
    const std::int32_t start = crystals.level_start[s.level - 1] +
                               static_cast<std::int32_t>(s.shape << (2 * static_cast<unsigned>(size_log2)));
    const Real half_size(0.5F * static_cast<float>(1 << size_log2));
    const Real last(static_cast<float>((1 << size_log2) - 1));
    const Real x = clamp(fma(u, half_size, half_size - Real(0.5F)), Real(0), last);
    const Real y = clamp(fma(v, half_size, half_size - Real(0.5F)), Real(0), last);
    const Real x0 = floor(x), y0 = floor(y);
    const Int left = truncate_to_int(x0), right = truncate_to_int(min(x0 + Real(1), last));
    const Int low = (truncate_to_int(y0) << size_log2) + Int(start),
              high = (truncate_to_int(min(y0 + Real(1), last)) << size_log2) + Int(start);
    const auto texel = [&](Int at) { return to_real<Real>(gather_bytes(crystals.texels, at)); };
    const Real below = texel(low + left) + (texel(low + right) - texel(low + left)) * (x - x0);
    const Real above = texel(high + left) + (texel(high + right) - texel(high + left)) * (x - x0);
    return (below + (above - below) * (y - y0)) * Real(1.0F / 255.0F);
}

struct Colour
{
    Real red, green, blue;
};

/// One row of a sprite.
template <bool Detailed>
SPINDRIFT_HD void blend_row(const SplatJob& job, const PlacedSprite& s, const Vec3f& ambient, int at,
                            int first, int last, float centre_x, const Real& py, TilePlanes& planes)
{
    const Real per_px(1 / s.r_px);
    const Real ramp = to_real<Real>(lane_numbers<IntOf<Real>>());
    for (int x = first; x <= last; x += static_cast<int>(kWidth))
    {
        const Real px = (ramp + Real(static_cast<float>(x) - centre_x)) * per_px;
        const Real rho2 = fma(px, px, py * py);
        const auto inside = rho2 <= Real(1);
        if (none(inside)) continue;
        Real opacity(s.opacity);
        // Far outside, the profile would be a denormal number, which the processor handles a hundred times
        // slower.
        if (!job.plain_discs) opacity = opacity * sprite_profile(min(rho2, Real(1)));
        Colour colour{Real(s.red), Real(s.green), Real(s.blue)};
        if constexpr (Detailed)
        {
            const Real detail(sprite_detail(s.r_px));
            const Real u = Real(s.cosine) * px + Real(s.sine) * py,
                       v = Real(s.cosine) * py - Real(s.sine) * px;
            const Real mean(job.crystals.means[s.shape]);
            opacity = opacity * (mean + detail * (sample_mask(job.crystals, s, u, v) - mean));
            const Real shade =
                imposter(px, py, Vec3<Real>{Real(s.right), Real(s.up), Real(s.to_viewer)}, detail);
            const Real most(static_cast<float>(kMostRadiance));
            colour = {min(fma(colour.red, shade, Real(ambient.x)), most),
                      min(fma(colour.green, shade, Real(ambient.y)), most),
                      min(fma(colour.blue, shade, Real(ambient.z)), most)};
        }
        opacity = job.real_flakes == 1 ? min(opacity, Real(static_cast<float>(kMostOpacity)))
                                       : weighted_opacity(opacity, Real(job.real_flakes));
        const Real z = load<Real>(planes.z + at + x);
        const Real alpha = select(inside, opacity * soft_edge(z, Real(s.z_m), Real(s.fade_per_m)), Real(0));
        const Real keep = job.additive ? Real(1) : Real(1) - alpha;
        const auto blend = [&](float* plane, const Real& value)
        { store(plane + at + x, fma(load<Real>(plane + at + x), keep, value * alpha)); };
        blend(planes.red, colour.red);
        blend(planes.green, colour.green);
        blend(planes.blue, colour.blue);
    }
}

template <bool Detailed>
SPINDRIFT_HD void blend_sprite(const SplatJob& job, const TilePlace& place, const PlacedSprite& s,
                               const Vec3f& ambient, TilePlanes& planes)
{
    // Pixel centres, relative to that of the tile's first pixel.
    const float centre_x = s.x_px - static_cast<float>(place.x0) - 0.5F;
    const float centre_y = s.y_px - static_cast<float>(place.y0) - 0.5F;
    const auto inside = [](float px, int most)
    { return static_cast<int>(min(max(px, 0.0F), static_cast<float>(most))); };
    const int first_x = inside(-floor(s.r_px - centre_x), kTilePx);
    const int last_x = inside(floor(centre_x + s.r_px) + 1, place.columns) - 1;
    const int first_y = inside(-floor(s.r_px - centre_y), kTilePx);
    const int last_y = inside(floor(centre_y + s.r_px) + 1, place.rows) - 1;
    for (int y = first_y; y <= last_y; ++y)
        blend_row<Detailed>(job, s, ambient, y * TilePlanes::kStride, first_x, last_x, centre_x,
                            Real((static_cast<float>(y) - centre_y) / s.r_px), planes);
}

void blend_tile(const SplatJob& job, const SplatPicture& picture, int x0, int y0, const PlacedSprite* sprites,
                const Vec3f* ambients, const std::uint32_t* which, std::size_t count)
{
    const TilePlace place{picture, x0, y0, min(kTilePx, picture.width_px - x0),
                          min(kTilePx, picture.height_px - y0)};
    if (count > 0)
    {
        TilePlanes planes;
        for (int row = 0; row < place.rows; ++row) load_row(place, job.view, row, planes);
        for (std::size_t i = 0; i < count; ++i)
        {
            __builtin_prefetch(sprites + which[i + kAhead < count ? i + kAhead : i]);
            const PlacedSprite& s = sprites[which[i]];
            if (s.level > 0)
                blend_sprite<true>(job, place, s, job.air.thick ? ambients[which[i]] : job.ambient, planes);
            else
                blend_sprite<false>(job, place, s, job.ambient, planes);
        }
        for (int row = 0; row < place.rows; ++row) store_row(place, row, planes);
    }
    if (picture.tone == nullptr) return;
    for (int row = 0; row < place.rows; ++row) develop_row(place, row);
}

}  // namespace

}  // namespace spindrift::cpu
