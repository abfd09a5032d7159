// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/philox.h"
#include "core/vec.h"
#include "core/world.h"

namespace spindrift
{

/// Flakes that a steady emitter has made by the end of `steps` steps: the integer part of rate · dt · steps.
/// Differences of it are whole, never negative, and add up exactly for any rate and step. 0 for rates that
/// are not positive.
SPINDRIFT_HD std::uint64_t emitted_after(double rate_per_s, double step_s, std::uint64_t steps)
{
    const double total = rate_per_s * step_s * static_cast<double>(steps);
    return total >= 1.0 && total < 0x1p63 ? static_cast<std::uint64_t>(total) : 0;
}

/// Flakes due in step `step` (the first is 0). Bursts come on top, before step 0.
SPINDRIFT_HD std::uint64_t emitted_in_step(double rate_per_s, double step_s, std::uint64_t step)
{
    return emitted_after(rate_per_s, step_s, step + 1) - emitted_after(rate_per_s, step_s, step);
}

/// Where a flake begins.
enum class StartPlace : std::uint32_t
{
    anywhere,  ///< uniform on the emitter's shape
    top,       ///< of later steps: a sky's on its top face, a drift's in the saltation layer
};

/// Uniform random positions on the shape of an emitter, from the flake's id alone. `centre` replaces
/// Emitter::a for a sky that follows an anchor. R: float, double or a pack (one id a lane).
template <class R>
struct StartSampler
{
    Emitter emitter;
    std::uint64_t seed;
    Vec3f centre;

    SPINDRIFT_HD StartSampler(const Emitter& e, std::uint64_t run_seed) : StartSampler(e, run_seed, e.a) {}
    SPINDRIFT_HD StartSampler(const Emitter& e, std::uint64_t run_seed, Vec3f sky_centre)
        : emitter(e), seed(run_seed), centre(sky_centre)
    {
    }

    /// `step` and `attempt` tell draws for one id apart.
    SPINDRIFT_HD Vec3<R> operator()(UIntOf<R> id, StartPlace place = StartPlace::anywhere,
                                    std::uint32_t step = 0, std::uint32_t attempt = 0) const
    {
        const auto words = random_words(seed, id, step, RandomStream::emission, attempt);
        const R s = uniform<R>(words.x0);
        const R t = uniform<R>(words.x1);
        const R u = uniform<R>(words.x2);
        const Vec3<R> a = widen(emitter.a);
        switch (emitter.shape)
        {
            case EmitterShape::point:
                return a;
            case EmitterShape::line:
                return a + (widen(emitter.b) - a) * s;
            case EmitterShape::plane:
                return a + (widen(emitter.b) - a) * s + (widen(emitter.c) - a) * t;
            case EmitterShape::box:
                return scaled(a, widen(emitter.b) - a, s, t, u);
            case EmitterShape::sphere_surface:
                return a + on_unit_sphere(s, t) * number<R>(emitter.radius_m);
            case EmitterShape::sphere_volume:
                return a +
                       on_unit_sphere(s, t) * (pow(u, number<R>(1.0 / 3.0)) * number<R>(emitter.radius_m));
            case EmitterShape::drift:  // see drifting()
            case EmitterShape::sky:
                break;
        }
        const R half = number<R>(0.5);
        const R height = place == StartPlace::top ? half : u - half;
        return scaled(widen(centre), widen(emitter.b), s - half, t - half, height);
    }

    /// On the ground of a drift, for a grain with this fall speed: `anywhere` as high as such grains hang in
    /// the wind, else evenly in the saltation layer.
    SPINDRIFT_HD Vec3<R> drifting(UIntOf<R> id, const R& fall, StartPlace place, std::uint32_t step,
                                  std::uint32_t attempt) const
    {
        const auto words = random_words(seed, id, step, RandomStream::emission, attempt);
        const Vec3<R> a = widen(emitter.a);
        const Vec3<R> edges = widen(emitter.b) - a;
        const R layer = number<R>(emitter.radius_m);
        const R share = uniform<R>(words.x2);
        const R up = place == StartPlace::anywhere
                         ? suspended_height(fall, number<R>(emitter.lift_m_s), layer, edges.z, share)
                         : share * layer;
        return {a.x + edges.x * uniform<R>(words.x0), a.y + edges.y * uniform<R>(words.x1), a.z + up};
    }

  private:
    static SPINDRIFT_HD Vec3<R> widen(Vec3f v) { return {number<R>(v.x), number<R>(v.y), number<R>(v.z)}; }

    static SPINDRIFT_HD Vec3<R> scaled(const Vec3<R>& from, const Vec3<R>& edges, R s, R t, R u)
    {
        return {from.x + edges.x * s, from.y + edges.y * t, from.z + edges.z * u};
    }

    /// Archimedes: the height of a point on the sphere is uniform.
    static SPINDRIFT_HD Vec3<R> on_unit_sphere(R s, R t)
    {
        const R height = s + s - number<R>(1);
        const R radius = sqrt(number<R>(1) - height * height);
        R sine, cosine;
        sincos_turns(t, sine, cosine);
        return {radius * cosine, radius * sine, height};
    }
};

}  // namespace spindrift
