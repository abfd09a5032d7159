// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/advect_job.h"
#include "core/flake.h"

namespace spindrift
{

/// How fast flakes fly at a moment: the air's mean and turbulent velocity where they are, settling and slip,
/// as a step moves them (core/advect.h).
class FlakeMotion
{
  public:
    /// The wind's cells stay the world's.
    explicit FlakeMotion(const World& world) : job_(advect_job(world, world.wind.cells.data(), Solids{})) {}

    /// m/s, local frame. The arrays of turbulence and slip may be null: flakes without.
    Vec3f velocity(const FlakeView& flakes, std::size_t slot) const
    {
        const Vec3f x{flakes.x[slot], flakes.y[slot], flakes.z[slot]};
        const bool whirled = job_.turbulent && flakes.q1 != nullptr;
        const Vec3f q = whirled ? Vec3f{flakes.q1[slot], flakes.q2[slot], flakes.q3[slot]} : Vec3f{};
        Vec3f v = air_at(x, q, whirled);
        if (flakes.slip_x != nullptr)
            v = v + Vec3f{flakes.slip_x[slot], flakes.slip_y[slot], flakes.slip_z[slot]};
        v.z -= job_.fall_speed.at<float>(flakes.id[slot], flakes.state[slot]);
        return v;
    }

  private:
    template <class WindField>
    static Vec3f in(const WindField& wind, const Vec3f& x, const Vec3f& q, bool whirled)
    {
        if (!whirled) return wind.mean(x);
        const Air<float> air = wind.air(x);
        return air.mean + turbulent_velocity(air, q);
    }
    Vec3f air_at(const Vec3f& x, const Vec3f& q, bool whirled) const
    {
        switch (job_.wind_kind)
        {
            case WindKind::uniform:
                return in(job_.uniform, x, q, whirled);
            case WindKind::logarithmic:
                return in(job_.logarithmic, x, q, whirled);
            case WindKind::grid:
                break;
        }
        return in(job_.grid, x, q, whirled);
    }

    AdvectJob job_;
};

}  // namespace spindrift
