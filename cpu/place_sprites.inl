// SPDX-License-Identifier: MIT
// Part of kernels.inl: flakes of the draw list become sprites, a pack at a time.

#include "core/airlight.h"
#include "core/sprite.h"

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

struct LitFlakes
{
    Vec3<Real> lamps;    // radiance
    Vec3<Real> towards;  // the lamps, weighted with their luminance
};

SPINDRIFT_HD LitFlakes light_flakes(const SplatJob& job, const Vec3<Real>& place, const Vec3<Real>& to_eye)
{
    const Vec3<Real> zero{Real(0), Real(0), Real(0)};
    LitFlakes sum{zero, zero};
    for (std::size_t i = 0; i < job.lamp_count; ++i)
    {
        const Lamp<Real> lamp = in_every_lane(job.lamps[i]);
        LampLight<Real> light = lamp_light(lamp, place);
        if (job.air.thick)
            light.irradiance = light.irradiance * reaching(in_every_lane(job.air.layers), lamp, place);
        if (i < job.shadows.lamps) light.irradiance = light.irradiance * lit_share(job.shadows, i, place);
        sum.lamps = sum.lamps + scattered(light, lamp.phase, to_eye);
        sum.towards = sum.towards + light.towards * luminance(light.irradiance);
    }
    return sum;
}

/// What of a flake's light reaches the eye.
struct SeenLight
{
    Real clear;          // share of its own light
    Vec3<Real> ambient;  // ambient light as it arrives, and the glow of the air between
};

SPINDRIFT_HD SeenLight see_through_air(const SplatJob& job, const Vec3<Real>& way, const Real& distance_m)
{
    const Vec3<Real> ambient = in_every_lane(job.ambient);
    if (!job.air.thick) return {Real(1), ambient};
    const Vec3<Real> forward = in_every_lane(job.view.forward);
    const AirPath<Real> path(in_every_lane(job.air.layers), in_every_lane(job.air.volume),
                             in_every_lane(job.view.eye), way, dot(way, forward));
    const Real clear = exp(-path.of_fog(distance_m));
    // What is added covers nothing: the glow of the air is in the picture already.
    if (job.additive) return {clear, ambient * clear};
    Vec3<Real> even = ambient, glow{Real(0), Real(0), Real(0)};
    for (std::size_t i = 0; i < job.lamp_count; ++i)
    {
        const Lamp<Real> lamp = in_every_lane(job.lamps[i]);
        const auto reach = [&](const Vec3<Real>& place) { return lit_share(job.shadows, i, place); };
        if (lamp.kind == LampKind::directional)
        {
            const Real share = i < job.shadows.lamps ? share_in_fog(path, distance_m, reach) : Real(1);
            even = even + lamp.intensity * (share * scattered_share(lamp.phase, -dot(lamp.direction, way)));
        }
        else if (job.air.glows)
            glow = glow + (i < job.shadows.lamps ? airlight_to(path, lamp, distance_m, reach)
                                                 : airlight_to(path, lamp, distance_m));
    }
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

SPINDRIFT_HD Real along(const Vec3<Real>& v, const Vec3f& axis)
{
    return fma(v.x, Real(axis.x), fma(v.y, Real(axis.y), v.z * Real(axis.z)));
}

/// First and last tile of each lane, as TileBox has them.
SPINDRIFT_HD void write_boxes(const Real& x, const Real& y, const Real& r, MaskOf<Real> drawn,
                              const View& view, std::size_t n, TileBox* boxes)
{
    const Real half(0.5F), zero(0), per_tile(1.0F / kTilePx);
    const Real most_x(static_cast<float>(view.width_px - 1)), most_y(static_cast<float>(view.height_px - 1));
    // Pixel centres within r, rounded outwards by a thousandth of a pixel.
    const Real reach = r + Real(1e-3F);
    const Real low_x = max(-floor(reach + half - x), zero), low_y = max(-floor(reach + half - y), zero);
    const Real high_x = min(floor(x + reach - half), most_x), high_y = min(floor(y + reach - half), most_y);
    const auto touches = drawn && low_x <= high_x && low_y <= high_y;
    const auto tile = [&](Real px) { return truncate_to_int(select(touches, px, zero) * per_tile); };
    std::int32_t first_x[kWidth], first_y[kWidth], last_x[kWidth], last_y[kWidth];
    store(first_x, tile(low_x));
    store(first_y, tile(low_y));
    store(last_x, tile(high_x));
    store(last_y, tile(high_y));
    const std::uint32_t some = mask_bits(touches);
    for (std::size_t l = 0; l < n; ++l)
        boxes[l] = {static_cast<std::int16_t>(some >> l & 1U ? first_x[l] : 1),
                    static_cast<std::int16_t>(first_y[l]), static_cast<std::int16_t>(last_x[l]),
                    static_cast<std::int16_t>(last_y[l])};
}

/// What only sprites with crystal and imposter need.
SPINDRIFT_HD void write_detail(const SplatJob& job, UIntOf<Real> base, const Real& r,
                               const Vec3<Real>& towards, std::uint32_t detailed, std::size_t n,
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
    for (std::size_t l = 0; l < n; ++l)
    {
        if ((detailed >> l & 1U) == 0) continue;
        PlacedSprite& s = sprites[l];
        s.right = right.v[l], s.up = up.v[l], s.to_viewer = -forward.v[l];
        s.cosine = cosines.v[l], s.sine = sines.v[l];
        s.level = static_cast<std::uint32_t>(levels.v[l]) + 1;
    }
}

/// n flakes in the slots, the rest of the slots repeats one of them.
SPINDRIFT_HD void place_pack(const SplatJob& job, const std::int32_t* slots, std::size_t n,
                             PlacedSprite* sprites, TileBox* boxes, Vec3f* ambients)
{
    const View& view = job.view;
    const auto slot = load<IntOf<Real>>(slots);
    const Vec3<Real> p{gather(job.flakes.x, slot), gather(job.flakes.y, slot), gather(job.flakes.z, slot)};
    const UIntOf<Real> id = gather(job.flakes.id, slot);
    const Vec3<Real> d{p.x - Real(view.eye.x), p.y - Real(view.eye.y), p.z - Real(view.eye.z)};
    const Real z = along(d, view.forward);
    const auto drawn = is_finite(p.x + p.y + p.z) && z > Real(view.near_m) && z < Real(view.far_m);

    const float focal = 0.5F * static_cast<float>(view.height_px) / view.tan_half_fov_y;
    const Real radius_m = job.sizes.diameter_m<Real>(id) * Real(0.5F * job.flake_scale);
    const SpriteSize<Real> size =
        sprite_size(radius_m, z, Real(focal), Real(job.largest_px), Real(view.near_m));
    const Real per_m = Real(focal) / z;
    const Real x = fma(along(d, view.right), per_m, Real(0.5F * static_cast<float>(view.width_px)));
    const Real y = fma(along(d, view.up), per_m, Real(0.5F * static_cast<float>(view.height_px)));
    Real opacity = size.opacity;
    if (job.air.thick) opacity = opacity * kept_of_tiny(Real(2) * radius_m * per_m);
    write_boxes(x, y, size.radius_px, drawn && opacity > Real(0), view, n, boxes);

    const Real distance_m = sqrt(dot(d, d));
    const Vec3<Real> to_eye = d * (Real(-1) / distance_m);
    LitFlakes lit = light_flakes(job, p, to_eye);
    const SeenLight seen = see_through_air(job, to_eye * Real(-1), distance_m);
    lit.lamps = lit.lamps * seen.clear;
    const auto detailed = size.radius_px > Real(kDetailFrom_px) && MaskOf<Real>(!job.plain_discs);
    const auto whole = [&](const Real& lamps, const Real& ambient)
    { return select(detailed, lamps, min(lamps + ambient, Real(static_cast<float>(kMostRadiance)))); };

    const UIntOf<Real> base = flake_base(job.sizes.seed, id);
    const LaneWords shapes(flake_trait(base, Trait::shape));
    const Lanes xs(x), ys(y), rs(size.radius_px), zs(z);
    const Lanes opacities(opacity * Real(job.plain_discs ? 1 : job.flake_opacity));
    const Lanes fades(Real(1) / max(radius_m, Real(static_cast<float>(kThinnestFade_m))));
    const Lanes reds(whole(lit.lamps.x, seen.ambient.x)), greens(whole(lit.lamps.y, seen.ambient.y)),
        blues(whole(lit.lamps.z, seen.ambient.z));
    const std::uint32_t large = mask_bits(detailed);
    for (std::size_t l = 0; l < n; ++l)
    {
        const std::uint32_t shape = shapes.v[l] % job.crystals.shapes;
        const float mean = (large >> l & 1U) != 0 || job.plain_discs ? 1 : job.crystals.means[shape];
        sprites[l] = {xs.v[l],    ys.v[l],   rs.v[l],     zs.v[l],    opacities.v[l] * mean,
                      fades.v[l], reds.v[l], greens.v[l], blues.v[l], 0,
                      0,          0,         1,           0,          shape,
                      0};
    }
    if (large == 0) return;
    if (job.air.thick)
    {
        const Lanes red(seen.ambient.x), green(seen.ambient.y), blue(seen.ambient.z);
        for (std::size_t l = 0; l < n; ++l) ambients[l] = {red.v[l], green.v[l], blue.v[l]};
    }
    write_detail(job, base, size.radius_px, lit.towards, large, n, sprites);
}

void place_sprites(const SplatJob& job, std::size_t first, std::size_t last, PlacedSprite* sprites,
                   TileBox* boxes, Vec3f* ambients)
{
    for (std::size_t i = first; i < last; i += kWidth)
    {
        const std::size_t n = last - i < kWidth ? last - i : kWidth;
        std::int32_t slots[kWidth];
        for (std::size_t l = 0; l < kWidth; ++l)
            slots[l] = static_cast<std::int32_t>(job.pairs[l < n ? i + l : i] & 0xFFFFFFFFU);
        place_pack(job, slots, n, sprites + i, boxes + i, job.air.thick ? ambients + i : nullptr);
    }
}

}  // namespace

}  // namespace spindrift::cpu
