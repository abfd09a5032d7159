// SPDX-License-Identifier: MIT
// Part of kernels.inl: flakes of the draw list become sprites, a pack at a time.

#include "core/airlight.h"
#include "core/sprite.h"
#include "core/streak.h"

namespace spindrift::cpu
{

namespace
{

SPINDRIFT_HD Lamp<Real> in_every_lane(const Lamp<float>& lamp)
{
    const auto wide = [](const Vec3f& v) { return Vec3<Real>{Real(v.x), Real(v.y), Real(v.z)}; };
    return {lamp.kind,
            wide(lamp.position_m),
            wide(lamp.direction),
            wide(lamp.intensity),
            Real(lamp.range_m),
            Real(lamp.cos_inner),
            Real(lamp.cos_outer),
            {lamp.phase.kind, Real(lamp.phase.g), Real(lamp.phase.g_back), Real(lamp.phase.back_share)}};
}

SPINDRIFT_HD Vec3<Real> in_every_lane(const Vec3f& v)
{
    return {Real(v.x), Real(v.y), Real(v.z)};
}

SPINDRIFT_HD AirLayers<Real> in_every_lane(const AirLayers<float>& air)
{
    return {Real(air.uniform_per_m), Real(air.drift_per_m), Real(air.drift_height_m), Real(air.drift_base_m)};
}

SPINDRIFT_HD FlakeVolume<Real> in_every_lane(const FlakeVolume<float>& volume)
{
    const FlakeShade<float>& shade = volume.shade;
    return {in_every_lane(volume.low),
            in_every_lane(volume.high),
            Real(volume.flakes_per_m3),
            {shade.area_m2, shade.integral_m3, shade.entries, shade.first_log2, shade.entries_per_log2}};
}

/// Numbers of the lamps that may count for one flake of a pack at least, ascending. The others give nothing
/// to any of them: what is left out changes no bit.
class PackLamps
{
  public:
    /// Without clusters: all lamps.
    SPINDRIFT_HD PackLamps(const SplatJob& job, const std::uint32_t* bits, const std::int32_t* clusters)
        : bits_(job.clusters.words > 0 ? bits : nullptr),
          clusters_(clusters),
          words_(job.clusters.words),
          lamps_(job.lamp_count)
    {
    }

    template <class Body>
    SPINDRIFT_HD void each(const Body& body) const
    {
        if (bits_ == nullptr)
        {
            for (std::size_t i = 0; i < lamps_; ++i) body(i);
            return;
        }
        for (std::size_t word = 0; word < words_; ++word)
            for (std::uint32_t left = any_of(word); left != 0; left &= left - 1)
                body(32 * word + static_cast<std::size_t>(__builtin_ctz(left)));
    }

  private:
    SPINDRIFT_HD std::uint32_t any_of(std::size_t word) const
    {
        std::uint32_t sum = 0;
        for (std::size_t l = 0; l < kWidth; ++l)
            if (l == 0 || clusters_[l] != clusters_[l - 1])
                sum |= bits_[static_cast<std::size_t>(clusters_[l]) * words_ + word];
        return sum;
    }

    const std::uint32_t* bits_;
    const std::int32_t* clusters_;
    std::size_t words_, lamps_;
};

struct LitFlakes
{
    Vec3<Real> lamps;    // radiance
    Vec3<Real> towards;  // the lamps, weighted with their luminance
};

SPINDRIFT_HD LitFlakes light_flakes(const SplatJob& job, const PackLamps& lamps, const Vec3<Real>& place,
                                    const Vec3<Real>& to_eye)
{
    const Vec3<Real> zero{Real(0), Real(0), Real(0)};
    LitFlakes sum{zero, zero};
    lamps.each(
        [&](std::size_t i)
        {
            const Lamp<Real> lamp = in_every_lane(job.lamps[i]);
            LampLight<Real> light = lamp_light(lamp, place);
            if (job.air.thick)
                light.irradiance = light.irradiance * reaching(in_every_lane(job.air.layers), lamp, place);
            if (i < job.shadows.lamps) light.irradiance = light.irradiance * lit_share(job.shadows, i, place);
            sum.lamps = sum.lamps + scattered(light, lamp.phase, to_eye);
            sum.towards = sum.towards + light.towards * luminance(light.irradiance);
        });
    return sum;
}

/// What of a flake's light reaches the eye.
struct SeenLight
{
    Real clear;          // share of its own light
    Vec3<Real> ambient;  // ambient light as it arrives, and the glow of the air between
};

SPINDRIFT_HD SeenLight see_through_air(const SplatJob& job, const PackLamps& lamps, const Vec3<Real>& way,
                                       const Real& distance_m)
{
    const Vec3<Real> ambient = in_every_lane(job.ambient);
    if (!job.air.thick) return {Real(1), ambient};
    const Vec3<Real> forward = in_every_lane(job.view.forward);
    const AirPath<Real> path(in_every_lane(job.air.layers), in_every_lane(job.air.volume),
                             in_every_lane(job.view.eye), way, dot(way, forward));
    const Real clear = exp(-path.of_fog(distance_m));
    // What is added covers nothing: the glow of the air is in the picture already.
    if (job.blending == SplatBlending::additive) return {clear, ambient * clear};
    Vec3<Real> even = ambient, glow{Real(0), Real(0), Real(0)};
    lamps.each(
        [&](std::size_t i)
        {
            const Lamp<Real> lamp = in_every_lane(job.lamps[i]);
            const bool shadowed = i < job.shadows.lamps;
            const auto reach = [&](const Vec3<Real>& place) { return lit_share(job.shadows, i, place); };
            if (lamp.kind == LampKind::directional)
            {
                const Real share = shadowed ? share_in_fog(path, distance_m, reach) : Real(1);
                even =
                    even + lamp.intensity * (share * scattered_share(lamp.phase, -dot(lamp.direction, way)));
            }
            else if (job.air.glows && job.glow.of(i) != nullptr)
                glow = glow + lamp.intensity *
                                  glow_in_grid(job.glow.of(i), lamp, path.eye, way, distance_m);
            else if (job.air.glows)
                glow = glow + (shadowed ? airlight_to(path, lamp, distance_m, reach)
                                        : airlight_to(path, lamp, distance_m));
        });
    return {clear, ambient * clear + even * (Real(1) - clear) + glow};
}

/// A value of each sprite of a pack.
struct Lanes
{
    alignas(64) float v[kWidth];
    SPINDRIFT_HD explicit Lanes(Real value) { store(v, value); }
};

struct LaneWords
{
    alignas(64) std::uint32_t v[kWidth];
    SPINDRIFT_HD explicit LaneWords(UIntOf<Real> value) { store(v, value); }
};

SPINDRIFT_HD float focal_px(const View& view)
{
    return 0.5F * static_cast<float>(view.height_px) / view.tan_half_fov_y;
}

SPINDRIFT_HD Real along(const Vec3<Real>& v, const Vec3f& axis)
{
    return fma(v.x, Real(axis.x), fma(v.y, Real(axis.y), v.z * Real(axis.z)));
}

/// Flakes of the draw list that are placed together; the lanes behind the last repeat one of them.
struct PackOfFlakes
{
    std::size_t n = 0;
    std::uint32_t at[kWidth];  ///< counted from the first flake of the call
    std::int32_t slots[kWidth];

    SPINDRIFT_HD void set(std::size_t lane, std::uint32_t which, std::uint64_t pair)
    {
        at[lane] = which;
        slots[lane] = static_cast<std::int32_t>(pair & 0xFFFFFFFFU);
    }
};

/// Where flakes stand on the picture.
struct Projected
{
    Vec3<Real> place, from_eye;  // m
    Real z, px_per_m, x, y;      // px from the lower left corner
};

SPINDRIFT_HD Projected project(const SplatJob& job, const std::int32_t* slots)
{
    const View& view = job.view;
    const auto slot = load<IntOf<Real>>(slots);
    Projected out;
    out.place = {gather(job.flakes.x, slot), gather(job.flakes.y, slot), gather(job.flakes.z, slot)};
    out.from_eye = out.place - in_every_lane(view.eye);
    out.z = along(out.from_eye, view.forward);
    out.px_per_m = Real(focal_px(view)) / out.z;
    out.x =
        fma(along(out.from_eye, view.right), out.px_per_m, Real(0.5F * static_cast<float>(view.width_px)));
    out.y = fma(along(out.from_eye, view.up), out.px_per_m, Real(0.5F * static_cast<float>(view.height_px)));
    return out;
}

/// What is written of each flake, and what is known of it, by place in the draw list from the first of a
/// call.
struct Placed
{
    PlacedSprite* sprites;
    TileBox* boxes;
    Vec3f* ambients;
    PlacedStreak* streaks;
    const Vec3f* velocities;
};

/// How far sprites reach on the picture from their centre, px.
struct Reach
{
    Real x, y;
};

/// Streaks of a pack, written out. `opacity`: at the centre of the flake at rest, before the weight. Returns
/// how far sprites reach with them.
SPINDRIFT_HD Reach write_streaks(const SplatJob& job, const PackOfFlakes& which, const Projected& at,
                                 const Real& radius_px, const Real& opacity, const Placed& out)
{
    float right[kWidth], up[kWidth], forward[kWidth];
    for (std::size_t l = 0; l < kWidth; ++l)
    {
        const Vec3f& v = out.velocities[which.at[l]];
        right[l] = dot(v, job.view.right), up[l] = dot(v, job.view.up), forward[l] = dot(v, job.view.forward);
    }
    const Vec3<Real> from_eye{along(at.from_eye, job.view.right), along(at.from_eye, job.view.up), at.z};
    Real x_px, y_px;
    streak_way(from_eye, Vec3<Real>{load<Real>(right), load<Real>(up), load<Real>(forward)}, at.px_per_m,
               Real(job.shutter_s), x_px, y_px);
    Streak<Real> streak = streak_of(x_px, y_px, radius_px, Real(job.largest_px));
    streak.even = even_share(opacity, Real(job.real_flakes));
    const Lanes xs(streak.along_x), ys(streak.along_y), halves(streak.half), evens(streak.even);
    for (std::size_t l = 0; l < which.n; ++l)
        out.streaks[which.at[l]] = {xs.v[l], ys.v[l], halves.v[l], evens.v[l]};
    const Real way = streak.half * radius_px;
    return {fma(abs(streak.along_x), way, radius_px), fma(abs(streak.along_y), way, radius_px)};
}

/// First and last tile of each lane, as TileBox has them.
SPINDRIFT_HD void write_boxes(const Real& x, const Real& y, const Reach& r, MaskOf<Real> drawn,
                              const View& view, const PackOfFlakes& which, TileBox* boxes)
{
    const Real half(0.5F), zero(0), per_tile(1.0F / kTilePx);
    const Real most_x(static_cast<float>(view.width_px - 1)), most_y(static_cast<float>(view.height_px - 1));
    // Pixel centres within r, rounded outwards by a thousandth of a pixel.
    const Real reach_x = r.x + Real(1e-3F), reach_y = r.y + Real(1e-3F);
    const Real low_x = max(-floor(reach_x + half - x), zero), low_y = max(-floor(reach_y + half - y), zero);
    const Real high_x = min(floor(x + reach_x - half), most_x);
    const Real high_y = min(floor(y + reach_y - half), most_y);
    const auto touches = drawn && low_x <= high_x && low_y <= high_y;
    const auto tile = [&](Real px) { return truncate_to_int(select(touches, px, zero) * per_tile); };
    std::int32_t first_x[kWidth], first_y[kWidth], last_x[kWidth], last_y[kWidth];
    store(first_x, tile(low_x));
    store(first_y, tile(low_y));
    store(last_x, tile(high_x));
    store(last_y, tile(high_y));
    const std::uint32_t some = mask_bits(touches);
    for (std::size_t l = 0; l < which.n; ++l)
        boxes[which.at[l]] = {static_cast<std::int16_t>(some >> l & 1U ? first_x[l] : 1),
                              static_cast<std::int16_t>(first_y[l]), static_cast<std::int16_t>(last_x[l]),
                              static_cast<std::int16_t>(last_y[l])};
}

/// What only sprites with crystal and imposter need.
SPINDRIFT_HD void write_detail(const SplatJob& job, UIntOf<Real> base, const Real& r,
                               const Vec3<Real>& towards, std::uint32_t detailed, const PackOfFlakes& which,
                               PlacedSprite* sprites)
{
    const auto share = [&](Trait trait) { return trait_uniform<Real>(flake_trait(base, trait)); };
    const Real turns =
        share(Trait::angle) + (share(Trait::spin) - Real(0.5F)) * Real(static_cast<float>(job.time_s));
    Real sine, cosine;
    sincos_turns(turns, sine, cosine);
    const Real length = sqrt(dot(towards, towards));
    const Vec3<Real> unit = towards * select(length > Real(0), Real(1) / length, Real(0));
    const Real level = floor(max(log2(Real(64) / r), Real(0)) + Real(0.5F));
    const Lanes cosines(cosine), sines(sine), levels(level);
    const Lanes right(along(unit, job.view.right)), up(along(unit, job.view.up)),
        forward(along(unit, job.view.forward));
    for (std::size_t l = 0; l < which.n; ++l)
    {
        if ((detailed >> l & 1U) == 0) continue;
        PlacedSprite& s = sprites[which.at[l]];
        s.right = right.v[l], s.up = up.v[l], s.to_viewer = -forward.v[l];
        s.cosine = cosines.v[l], s.sine = sines.v[l];
        s.level = static_cast<std::uint32_t>(levels.v[l]) + 1;
    }
}

SPINDRIFT_HD void place_pack(const SplatJob& job, const PackOfFlakes& which, const Placed& out)
{
    const View& view = job.view;
    const Projected at = project(job, which.slots);
    const Vec3<Real>& p = at.place;
    const Real& z = at.z;
    const UIntOf<Real> id = gather(job.flakes.id, load<IntOf<Real>>(which.slots));
    const auto drawn = is_finite(p.x + p.y + p.z) && z > Real(view.near_m) && z < Real(view.far_m);

    const Real radius_m = job.sizes.diameter_m<Real>(id) * Real(0.5F * job.flake_scale);
    const SpriteSize<Real> size =
        sprite_size(radius_m, z, Real(focal_px(view)), Real(job.largest_px), Real(view.near_m));
    Real opacity = size.opacity;
    if (job.air.thick) opacity = opacity * kept_of_tiny(Real(2) * radius_m * at.px_per_m);
    std::int32_t clusters[kWidth] = {};
    if (job.clusters.words > 0) store(clusters, cluster_of(job.clusters.grid, at.x, at.y, z));
    const Real distance_m = sqrt(dot(at.from_eye, at.from_eye));
    const Vec3<Real> to_eye = at.from_eye * (Real(-1) / distance_m);
    LitFlakes lit = light_flakes(job, PackLamps(job, job.clusters.lit, clusters), p, to_eye);
    const SeenLight seen = see_through_air(job, PackLamps(job, job.clusters.on_the_way, clusters),
                                           to_eye * Real(-1), distance_m);
    lit.lamps = lit.lamps * seen.clear;
    const auto detailed = size.radius_px > Real(kDetailFrom_px) && MaskOf<Real>(!job.plain_discs);
    const auto whole = [&](const Real& lamps, const Real& ambient)
    { return select(detailed, lamps, min(lamps + ambient, Real(static_cast<float>(kMostRadiance)))); };

    const UIntOf<Real> base = flake_base(job.sizes.seed, id);
    const LaneWords shapes(flake_trait(base, Trait::shape));
    alignas(64) float means[kWidth];
    const std::uint32_t large = mask_bits(detailed);
    for (std::size_t l = 0; l < kWidth; ++l)
        means[l] = job.plain_discs ? 1 : job.crystals.means[shapes.v[l] % job.crystals.shapes];
    opacity = opacity * Real(job.plain_discs ? 1 : job.flake_opacity);
    const Real mean_opacity = opacity * load<Real>(means);
    Reach reach{size.radius_px, size.radius_px};
    if (job.shutter_s > 0) reach = write_streaks(job, which, at, size.radius_px, mean_opacity, out);
    write_boxes(at.x, at.y, reach, drawn && opacity > Real(0), view, which, out.boxes);
    const Lanes xs(at.x), ys(at.y), rs(size.radius_px), zs(z);
    // Detailed sprites look up their mask pixel by pixel.
    const Lanes opacities(select(detailed, opacity, mean_opacity));
    const Lanes fades(Real(1) / max(radius_m, Real(static_cast<float>(kThinnestFade_m))));
    const Lanes reds(whole(lit.lamps.x, seen.ambient.x)), greens(whole(lit.lamps.y, seen.ambient.y)),
        blues(whole(lit.lamps.z, seen.ambient.z));
    for (std::size_t l = 0; l < which.n; ++l)
        out.sprites[which.at[l]] = {xs.v[l],    ys.v[l],   rs.v[l],     zs.v[l],    opacities.v[l],
                                    fades.v[l], reds.v[l], greens.v[l], blues.v[l], 0,
                                    0,          0,         1,           0,          shapes.v[l],
                                    0};
    if (large == 0) return;
    if (job.air.thick)
    {
        const Lanes red(seen.ambient.x), green(seen.ambient.y), blue(seen.ambient.z);
        for (std::size_t l = 0; l < which.n; ++l)
            out.ambients[which.at[l]] = {red.v[l], green.v[l], blue.v[l]};
    }
    write_detail(job, base, size.radius_px, lit.towards, large, which, out.sprites);
}

/// Most flakes that are put in order at once: what their order takes lies on the stack.
constexpr std::size_t kOrdered = 4096;

/// Numbers 0 to count - 1 of flakes, those of one cluster after each other: packs whose flakes have lamps in
/// common light them together.
SPINDRIFT_HD void order_by_cluster(const SplatJob& job, const std::uint64_t* pairs, std::size_t count,
                                   std::uint16_t* order)
{
    std::uint16_t cluster[kOrdered + kWidth];
    std::uint16_t starts[ClusterGrid::count() + 1] = {};
    for (std::size_t i = 0; i < count; i += kWidth)
    {
        std::int32_t slots[kWidth], in[kWidth];
        for (std::size_t l = 0; l < kWidth; ++l)
            slots[l] = static_cast<std::int32_t>(pairs[i + l < count ? i + l : count - 1] & 0xFFFFFFFFU);
        const Projected at = project(job, slots);
        store(in, cluster_of(job.clusters.grid, at.x, at.y, at.z));
        for (std::size_t l = 0; l < kWidth; ++l) cluster[i + l] = static_cast<std::uint16_t>(in[l]);
    }
    for (std::size_t i = 0; i < count; ++i) ++starts[cluster[i] + 1];
    for (std::size_t c = 0; c < ClusterGrid::count(); ++c)
        starts[c + 1] = static_cast<std::uint16_t>(starts[c + 1] + starts[c]);
    for (std::size_t i = 0; i < count; ++i) order[starts[cluster[i]]++] = static_cast<std::uint16_t>(i);
}

void place_sprites(const SplatJob& job, std::size_t first, std::size_t last, PlacedSprite* sprites,
                   TileBox* boxes, Vec3f* ambients, PlacedStreak* streaks)
{
    const bool ordered = job.clusters.words > 0;
    for (std::size_t block = first; block < last; block += kOrdered)
    {
        const std::size_t count = last - block < kOrdered ? last - block : kOrdered;
        std::uint16_t order[kOrdered];
        const bool streaked = job.shutter_s > 0;
        const Placed out{sprites + block, boxes + block, job.air.thick ? ambients + block : nullptr,
                         streaked ? streaks + block : nullptr, streaked ? job.velocities + block : nullptr};
        if (ordered) order_by_cluster(job, job.pairs + block, count, order);
        for (std::size_t i = 0; i < count; i += kWidth)
        {
            PackOfFlakes which;
            which.n = count - i < kWidth ? count - i : kWidth;
            for (std::size_t l = 0; l < kWidth; ++l)
            {
                const std::size_t at = l < which.n ? i + l : i;
                const std::size_t flake = ordered ? order[at] : at;
                which.set(l, static_cast<std::uint32_t>(flake), job.pairs[block + flake]);
            }
            place_pack(job, which, out);
        }
    }
}

}  // namespace

}  // namespace spindrift::cpu
