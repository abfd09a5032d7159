// SPDX-License-Identifier: MIT
// Part of kernels.inl: sprites are blended into one tile of the picture, a pack of pixels of a row at a time.

#include "core/sprite.h"
#include "core/streak.h"
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
SPINDRIFT_HD Real sample_mask(const CrystalTexels& crystals, const PlacedSprite& s, std::uint32_t shape,
                              const Real& u, const Real& v)
{
    using Int = IntOf<Real>;
    const int size_log2 = crystals.size_log2 - static_cast<int>(s.level - 1);
    const std::int32_t start = crystals.level_start[s.level - 1] +
                               static_cast<std::int32_t>(shape << (2 * static_cast<unsigned>(size_log2)));
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

/// Adds `share` of a colour to what `keep` leaves of three planes.
SPINDRIFT_HD void blend_into(float* red, float* green, float* blue, const Colour& colour, const Real& share,
                             const Real& keep)
{
    store(red, fma(load<Real>(red), keep, colour.red * share));
    store(green, fma(load<Real>(green), keep, colour.green * share));
    store(blue, fma(load<Real>(blue), keep, colour.blue * share));
}

// How sprites that overlap make a pixel: each of these gets the dabs of a tile in the order of the list.

struct OverBlender
{
    SPINDRIFT_HD OverBlender(const SplatJob&, const TilePlace&, const TilePlanes&) {}
    SPINDRIFT_HD void sprite(const PlacedSprite&) {}
    SPINDRIFT_HD void dab(TilePlanes& planes, int at, int, int, const Real& alpha, const Colour& colour)
    {
        blend_into(planes.red + at, planes.green + at, planes.blue + at, colour, alpha, Real(1) - alpha);
    }
    SPINDRIFT_HD void finish(TilePlanes&) {}
};

struct AdditiveBlender
{
    SPINDRIFT_HD AdditiveBlender(const SplatJob&, const TilePlace&, const TilePlanes&) {}
    SPINDRIFT_HD void sprite(const PlacedSprite&) {}
    SPINDRIFT_HD void dab(TilePlanes& planes, int at, int, int, const Real& alpha, const Colour& colour)
    {
        blend_into(planes.red + at, planes.green + at, planes.blue + at, colour, alpha, Real(1));
    }
    SPINDRIFT_HD void finish(TilePlanes&) {}
};

/// The mean of all flakes' colours, weighted with alpha and depth, covers what all of them cover. McGuire and
/// Bavoil, Journal of Computer Graphics Techniques 2 (2013), with a weight of our own.
class WeightedBlender
{
  public:
    SPINDRIFT_HD WeightedBlender(const SplatJob& job, const TilePlace& place, const TilePlanes&)
        : extinction_per_m_(job.extinction_per_m), end_(place.rows * TilePlanes::kStride)
    {
        for (float& value : left_) value = 1;
    }
    SPINDRIFT_HD void sprite(const PlacedSprite& s)
    {
        weight_ = Real(unsorted_weight(extinction_per_m_, s.z_m));
    }
    SPINDRIFT_HD void dab(TilePlanes&, int at, int, int, const Real& alpha, const Colour& colour)
    {
        const Real share = alpha * weight_;
        blend_into(red_ + at, green_ + at, blue_ + at, colour, share, Real(1));
        store(sum_ + at, load<Real>(sum_ + at) + share);
        store(left_ + at, load<Real>(left_ + at) * (Real(1) - alpha));
    }
    SPINDRIFT_HD void finish(TilePlanes& planes)
    {
        for (int at = 0; at < end_; at += static_cast<int>(kWidth))
        {
            const Real sum = load<Real>(sum_ + at), left = load<Real>(left_ + at);
            const Real share = select(sum > Real(0), (Real(1) - left) / sum, Real(0));
            const Colour mean{load<Real>(red_ + at), load<Real>(green_ + at), load<Real>(blue_ + at)};
            blend_into(planes.red + at, planes.green + at, planes.blue + at, mean, share, left);
        }
    }

  private:
    float extinction_per_m_;
    int end_;
    Real weight_{0};
    alignas(64) float red_[kTilePx * TilePlanes::kStride] = {};
    alignas(64) float green_[kTilePx * TilePlanes::kStride] = {};
    alignas(64) float blue_[kTilePx * TilePlanes::kStride] = {};
    alignas(64) float sum_[kTilePx * TilePlanes::kStride] = {};
    alignas(64) float left_[kTilePx * TilePlanes::kStride];  ///< of what lies behind
};

/// Each sample of a pixel shows the nearest of the flakes that cover it, by chance. Enderton et al., I3D
/// 2010.
class StochasticBlender
{
  public:
    SPINDRIFT_HD StochasticBlender(const SplatJob& job, const TilePlace& place, const TilePlanes& planes)
        : samples_(job.samples), x0_(place.x0), y0_(place.y0), end_(place.rows * TilePlanes::kStride)
    {
        const auto bytes = static_cast<std::size_t>(end_) * sizeof(float);
        for (int s = 0; s < samples_; ++s)
        {
            __builtin_memcpy(sample_[s].z, planes.z, bytes);
            __builtin_memcpy(sample_[s].red, planes.red, bytes);
            __builtin_memcpy(sample_[s].green, planes.green, bytes);
            __builtin_memcpy(sample_[s].blue, planes.blue, bytes);
        }
    }
    SPINDRIFT_HD void sprite(const PlacedSprite& s)
    {
        z_ = Real(s.z_m);
        hash_ = UIntOf<Real>(s.hash);
    }
    SPINDRIFT_HD void dab(TilePlanes&, int at, int x, int y, const Real& alpha, const Colour& colour)
    {
        using UInt = UIntOf<Real>;
        const UInt column = as_uint(lane_numbers<IntOf<Real>>() + IntOf<Real>(x0_ + x));
        const Real first = grain<Real>(hash_, column, UInt(static_cast<std::uint32_t>(y0_ + y)));
        for (int s = 0; s < samples_; ++s)
        {
            TilePlanes& sample = sample_[s];
            const Real turned = first + Real(static_cast<float>(s) / static_cast<float>(samples_));
            const Real chance = turned - select(turned >= Real(1), Real(1), Real(0));
            const auto covers = chance < alpha && z_ < load<Real>(sample.z + at);
            if (none(covers)) continue;
            const auto put = [&](float* plane, const Real& value)
            { store(plane + at, select(covers, value, load<Real>(plane + at))); };
            put(sample.z, z_);
            put(sample.red, colour.red);
            put(sample.green, colour.green);
            put(sample.blue, colour.blue);
        }
    }
    SPINDRIFT_HD void finish(TilePlanes& planes)
    {
        const Real share(1.0F / static_cast<float>(samples_));
        for (int at = 0; at < end_; at += static_cast<int>(kWidth))
        {
            Colour sum{Real(0), Real(0), Real(0)};
            for (int s = 0; s < samples_; ++s)
            {
                sum.red = sum.red + load<Real>(sample_[s].red + at);
                sum.green = sum.green + load<Real>(sample_[s].green + at);
                sum.blue = sum.blue + load<Real>(sample_[s].blue + at);
            }
            blend_into(planes.red + at, planes.green + at, planes.blue + at, sum, share, Real(0));
        }
    }

  private:
    int samples_, x0_, y0_, end_;
    Real z_{0};
    UIntOf<Real> hash_{0U};
    TilePlanes sample_[kMostSamples];
};

SPINDRIFT_HD Streak<Real> in_every_lane(const PlacedStreak& streak)
{
    return {Real(streak.along_x), Real(streak.along_y), Real(streak.half), Real(streak.even)};
}

/// One row of a sprite. `streak`: null for a flake that stands still.
template <bool Detailed, class Blender>
SPINDRIFT_HD void blend_row(const SplatJob& job, const PlacedSprite& s, const PlacedStreak* streak,
                            const Vec3f& ambient, int y, int first, int last, float centre_x, const Real& py,
                            TilePlanes& planes, Blender& blender)
{
    const int at = y * TilePlanes::kStride;
    const Real per_px(1 / s.r_px);
    const Real ramp = to_real<Real>(lane_numbers<IntOf<Real>>());
    for (int x = first; x <= last; x += static_cast<int>(kWidth))
    {
        const Real px = (ramp + Real(static_cast<float>(x) - centre_x)) * per_px;
        const Real rho2 = fma(px, px, py * py);
        Real profile(1);
        if (streak != nullptr) profile = streak_profile(in_every_lane(*streak), px, py, job.plain_discs);
        const auto inside = streak != nullptr ? profile > Real(0) : rho2 <= Real(1);
        if (none(inside)) continue;
        // Far outside, the profile would be a denormal number, which the processor handles a hundred times
        // slower.
        if (streak == nullptr && !job.plain_discs) profile = sprite_profile(min(rho2, Real(1)));
        Real mask(1), mean(1);
        Colour colour{Real(s.red), Real(s.green), Real(s.blue)};
        if constexpr (Detailed)
        {
            Real detail(sprite_detail(s.r_px));
            if (streak != nullptr) detail = detail * streak_detail(in_every_lane(*streak));
            const Real u = Real(s.cosine) * px + Real(s.sine) * py,
                       v = Real(s.cosine) * py - Real(s.sine) * px;
            const std::uint32_t shape = s.hash % job.crystals.shapes;
            mean = Real(job.crystals.means[shape]);
            mask = mean + detail * (sample_mask(job.crystals, s, shape, u, v) - mean);
            const Real shade =
                imposter(px, py, Vec3<Real>{Real(s.right), Real(s.up), Real(s.to_viewer)}, detail);
            const Real most(static_cast<float>(kMostRadiance));
            colour = {min(fma(colour.red, shade, Real(ambient.x)), most),
                      min(fma(colour.green, shade, Real(ambient.y)), most),
                      min(fma(colour.blue, shade, Real(ambient.z)), most)};
        }
        const auto weighted = [&](const Real& opacity)
        {
            return job.real_flakes == 1 ? min(opacity, Real(static_cast<float>(kMostOpacity)))
                                        : weighted_opacity(opacity, Real(job.real_flakes));
        };
        Real opacity(s.opacity);
        if (streak != nullptr)
            opacity = min(weighted(opacity * mean) * profile * (mask / mean), Real(1));
        else
        {
            if (!job.plain_discs) opacity = opacity * profile;
            if constexpr (Detailed) opacity = opacity * mask;
            opacity = weighted(opacity);
        }
        const Real z = load<Real>(planes.z + at + x);
        const Real alpha = select(inside, opacity * soft_edge(z, Real(s.z_m), Real(s.fade_per_m)), Real(0));
        blender.dab(planes, at + x, x, y, alpha, colour);
    }
}

template <bool Detailed, class Blender>
SPINDRIFT_HD void blend_sprite(const SplatJob& job, const TilePlace& place, const PlacedSprite& s,
                               const PlacedStreak* streak, const Vec3f& ambient, TilePlanes& planes,
                               Blender& blender)
{
    // Pixel centres, relative to that of the tile's first pixel.
    const float centre_x = s.x_px - static_cast<float>(place.x0) - 0.5F;
    const float centre_y = s.y_px - static_cast<float>(place.y0) - 0.5F;
    const auto inside = [](float px, int most)
    { return static_cast<int>(min(max(px, 0.0F), static_cast<float>(most))); };
    const float way = streak != nullptr ? streak->half * s.r_px : 0;
    const float reach_x = streak != nullptr ? fma(abs(streak->along_x), way, s.r_px) : s.r_px;
    const float reach_y = streak != nullptr ? fma(abs(streak->along_y), way, s.r_px) : s.r_px;
    const int first_x = inside(-floor(reach_x - centre_x), kTilePx);
    const int last_x = inside(floor(centre_x + reach_x) + 1, place.columns) - 1;
    const int first_y = inside(-floor(reach_y - centre_y), kTilePx);
    const int last_y = inside(floor(centre_y + reach_y) + 1, place.rows) - 1;
    for (int y = first_y; y <= last_y; ++y)
        blend_row<Detailed>(job, s, streak, ambient, y, first_x, last_x, centre_x,
                            Real((static_cast<float>(y) - centre_y) / s.r_px), planes, blender);
}

template <class Blender>
void blend_sprites(const SplatJob& job, const TilePlace& place, const PlacedSprite* sprites,
                   const Vec3f* ambients, const PlacedStreak* streaks, const std::uint32_t* which,
                   std::size_t count, TilePlanes& planes)
{
    Blender blender(job, place, planes);
    for (std::size_t i = 0; i < count; ++i)
    {
        __builtin_prefetch(sprites + which[i + kAhead < count ? i + kAhead : i]);
        const PlacedSprite& s = sprites[which[i]];
        blender.sprite(s);
        const PlacedStreak* streak = job.shutter_s > 0 ? streaks + which[i] : nullptr;
        if (streak != nullptr && streak->half == 0) streak = nullptr;
        if (s.level > 0)
            blend_sprite<true>(job, place, s, streak, job.air.thick ? ambients[which[i]] : job.ambient,
                               planes, blender);
        else
            blend_sprite<false>(job, place, s, streak, job.ambient, planes, blender);
    }
    blender.finish(planes);
}

void blend_tile(const SplatJob& job, const SplatPicture& picture, int x0, int y0, const PlacedSprite* sprites,
                const Vec3f* ambients, const PlacedStreak* streaks, const std::uint32_t* which,
                std::size_t count)
{
    const TilePlace place{picture, x0, y0, min(kTilePx, picture.width_px - x0),
                          min(kTilePx, picture.height_px - y0)};
    if (count > 0)
    {
        TilePlanes planes;
        for (int row = 0; row < place.rows; ++row) load_row(place, job.view, row, planes);
        switch (job.blending)
        {
            case SplatBlending::over:
                blend_sprites<OverBlender>(job, place, sprites, ambients, streaks, which, count, planes);
                break;
            case SplatBlending::additive:
                blend_sprites<AdditiveBlender>(job, place, sprites, ambients, streaks, which, count, planes);
                break;
            case SplatBlending::weighted:
                blend_sprites<WeightedBlender>(job, place, sprites, ambients, streaks, which, count, planes);
                break;
            case SplatBlending::stochastic:
                blend_sprites<StochasticBlender>(job, place, sprites, ambients, streaks, which, count,
                                                 planes);
                break;
        }
        for (int row = 0; row < place.rows; ++row) store_row(place, row, planes);
    }
    if (picture.tone == nullptr) return;
    for (int row = 0; row < place.rows; ++row) develop_row(place, row);
}

}  // namespace

}  // namespace spindrift::cpu
