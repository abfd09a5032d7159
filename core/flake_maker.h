// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/advect_job.h"
#include "core/emit.h"
#include "core/philox.h"
#include "core/world.h"

namespace spindrift
{

/// Makes single flakes of a step: place, turbulence and slip from the flake's id alone.
struct FlakeMaker
{
    /// Places that are tried for a flake that would come into being inside a solid.
    static constexpr std::uint32_t kPlaces = 8;

    const AdvectJob& job;  ///< its regions are those of the beginning of the step
    StepParams step;

    /// Writes flake `id` of emitter `e` to a slot; false if it found no room and is a hole already.
    SPINDRIFT_HD bool operator()(const Emitter& emitter, std::uint32_t e, std::uint32_t id, StartPlace place,
                                 std::size_t slot) const
    {
        const FlakeView& f = job.flakes;
        Vec3f x{};
        bool blocked = true;
        for (std::uint32_t attempt = 0; attempt < kPlaces && blocked; ++attempt)
        {
            x = position(emitter, e, id, place, attempt);
            blocked = job.around.is_blocked(x);
        }
        const Vec3f q = turbulence(id);
        const Vec3f slip = start_slip(emitter, job.fall_speed.at<float>(id, e << 8), x, q);
        f.x[slot] = x.x, f.y[slot] = x.y, f.z[slot] = x.z;
        f.q1[slot] = q.x, f.q2[slot] = q.y, f.q3[slot] = q.z;
        f.slip_x[slot] = slip.x, f.slip_y[slot] = slip.y, f.slip_z[slot] = slip.z;
        f.id[slot] = id;
        f.state[slot] = e << 8 | static_cast<std::uint32_t>(blocked ? Fate::vanished : Fate::alive);
        return !blocked;
    }

  private:
    /// Where a flake starts; `attempt` > 0 are other places for it.
    SPINDRIFT_HD Vec3f position(const Emitter& emitter, std::uint32_t e, std::uint32_t id, StartPlace place,
                                std::uint32_t attempt) const
    {
        const bool sky = emitter.shape == EmitterShape::sky;
        const Region& region = job.around.regions[e];
        const Vec3f centre = sky ? (region.lower + region.upper) * 0.5F : emitter.a;
        const StartSampler<float> sampler(emitter, step.seed, centre);
        if (emitter.shape != EmitterShape::drift) return sampler(id, place, step.number, attempt);
        return sampler.drifting(id, job.fall_speed.at<float>(id, e << 8), place, step.number, attempt);
    }

    /// A flake with inertia holds its velocity there.
    SPINDRIFT_HD Vec3f start_slip(const Emitter& emitter, float fall, const Vec3f& x, const Vec3f& q) const
    {
        if (emitter.at_rest_in_air && !job.step.inertial) return {0, 0, 0};
        if (!emitter.at_rest_in_air && job.step.inertial) return emitter.velocity_m_s;
        Vec3f carried = air_velocity(x, q);
        carried.z -= fall;
        return emitter.at_rest_in_air ? carried : emitter.velocity_m_s - carried;
    }

    SPINDRIFT_HD Vec3f turbulence(std::uint32_t id) const
    {
        if (!job.turbulent) return {0, 0, 0};
        const Gaussians<float> g =
            gaussians<float>(step.seed, id, step.number, RandomStream::turbulence_start);
        return {g.x, g.y, g.z};
    }

    /// Air at a place where a flake starts: what its slip is reckoned from.
    SPINDRIFT_HD Vec3f air_velocity(const Vec3f& x, const Vec3f& q) const
    {
        switch (job.wind_kind)
        {
            case WindKind::uniform:
                return velocity(job.uniform, x, q);
            case WindKind::logarithmic:
                return velocity(job.logarithmic, x, q);
            case WindKind::grid:
                break;
        }
        return velocity(job.grid, x, q);
    }

    template <class WindField>
    SPINDRIFT_HD Vec3f velocity(const WindField& wind, const Vec3f& x, const Vec3f& q) const
    {
        if (!job.turbulent) return wind.mean(x);
        const Air<float> air = wind.air(x);
        return air.mean + turbulent_velocity(air, q);
    }
};

}  // namespace spindrift
