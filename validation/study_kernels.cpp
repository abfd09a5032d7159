// SPDX-License-Identifier: MIT
// Like the kernels of cpu/: compiled for one instruction set, and free of anything that the rest of the
// program could share.
#include "validation/study_kernels.h"

#include "core/advect.h"
#include "validation/integrators.h"

namespace spindrift::validation
{

namespace
{

/// x within one period; NaN stays.
template <class R>
SPINDRIFT_HD R wrapped(const R& x)
{
    const R inside = x - floor(x);
    return inside >= R(1) ? R(0) : inside;
}

/// Flakes may go farther in a step than the half period that the grid goes on.
struct OnePeriod
{
    StudyGrid<float, Sampling::trilinear> grid;
    SPINDRIFT_HD Air<double> air(const Vec3d& x) const { return grid.air(Vec3d{wrapped(x.x), x.y, x.z}); }
};

template <class Step>
SPINDRIFT_HD std::size_t step_all(const RivalField& field, const FlakeView& f, std::size_t count, float dt,
                                  std::uint64_t seed, std::uint32_t number)
{
    const StudyGrid<float, Sampling::trilinear> grid{field.grid, field.numbers};
    const auto air_at = [&](const Vec3f& x)
    {
        float v[16];
        grid.read(Vec3f{wrapped(x.x), x.y, x.z}, v);
        return stress_air_of(v);
    };
    std::size_t rogue = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
        if (f.state[i] != 0) continue;
        Vec3f x{f.x[i], f.y[i], f.z[i]}, u{f.q1[i], f.q2[i], f.q3[i]};
        const Gaussians<float> g = gaussians<float>(seed, f.id[i], number, RandomStream::turbulence);
        Step::step(air_at, dt, Vec3f{g.x, g.y, g.z}, x, u);
        // sigma is at most sqrt(2.1) m/s here
        const float most = max(abs(u.x), max(abs(u.y), abs(u.z)));
        if (!(most < 14.5F && is_finite(x.x + u.x + u.y + u.z)))
        {
            f.state[i] = static_cast<std::uint32_t>(Fate::vanished);
            ++rogue;
            continue;
        }
        f.x[i] = wrapped(x.x), f.y[i] = x.y, f.z[i] = x.z;
        f.q1[i] = u.x, f.q2[i] = u.y, f.q3[i] = u.z;
    }
    return rogue;
}

template <class Grid>
SPINDRIFT_HD void advect_on(const Grid& grid, const AdvectJob& job, std::size_t count)
{
    const FlakeAdvector<float, Grid, true> advector{job.step, grid, job.fall_speed, job.around, job.flakes};
    std::uint32_t lost = 0;
    EncounterTally tally;
    tally.lost = &lost;
    for (std::size_t i = 0; i < count; ++i) advector(i, tally);
}

template <class Store>
SPINDRIFT_HD void advect_sampled(const AdvectJob& job, const Store* numbers, Sampling sampling,
                                 std::size_t count)
{
    if (sampling == Sampling::nearest)
        advect_on(StudyGrid<Store, Sampling::nearest>{job.grid, numbers}, job, count);
    else
        advect_on(StudyGrid<Store, Sampling::trilinear>{job.grid, numbers}, job, count);
}

}  // namespace

std::size_t step_rival(Rival rival, const RivalField& field, const FlakeView& flakes, std::size_t count,
                       float dt, std::uint64_t seed, std::uint32_t number)
{
    if (rival == Rival::explicit_euler)
        return step_all<ExplicitEuler>(field, flakes, count, dt, seed, number);
    if (rival == Rival::bailey) return step_all<Bailey>(field, flakes, count, dt, seed, number);
    return step_all<ExactOuPlusSum>(field, flakes, count, dt, seed, number);
}

void step_on_grid(const AdvectJob& job, const float* numbers, Sampling sampling, std::size_t count)
{
    advect_sampled(job, numbers, sampling, count);
}

void step_on_grid(const AdvectJob& job, const std::uint16_t* numbers, Sampling sampling, std::size_t count)
{
    advect_sampled(job, numbers, sampling, count);
}

void step_in_double(const GridWind& grid, const float* numbers, double* states, const std::uint32_t* ids,
                    std::size_t count, const StepParams& step, double dt, std::uint32_t number)
{
    const OnePeriod wind{{grid, numbers}};
    for (std::size_t i = 0; i < count; ++i)
    {
        double* s = states + 6 * i;
        Vec3d x{s[0], s[1], s[2]}, q{s[3], s[4], s[5]};
        const auto noise = [&](int r)
        {
            const Gaussians<double> g = gaussians<double>(step.seed, ids[i], number, RandomStream::turbulence,
                                                          static_cast<std::uint32_t>(r));
            return Vec3d{g.x, g.y, g.z};
        };
        Whitened::step(wind, dt, step.relaxations, noise, x, q);
        s[0] = wrapped(x.x), s[1] = x.y, s[2] = x.z;
        s[3] = q.x, s[4] = q.y, s[5] = q.z;
    }
}

}  // namespace spindrift::validation
