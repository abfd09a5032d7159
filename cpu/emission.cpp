// SPDX-License-Identifier: MIT
#include "cpu/emission.h"

#include <algorithm>
#include <numeric>

#include "core/emit.h"
#include "cpu/chunks.h"
#include "cpu/parallel.h"

namespace spindrift::cpu
{

namespace
{

/// Places that are tried for a flake that would come into being inside a solid.
constexpr std::uint32_t kPlaces = 8;

/// Air at a place where a flake starts: what its slip is reckoned from.
Vec3f air_velocity(const AdvectJob& job, const Vec3f& x, const Vec3f& q)
{
    const auto velocity = [&](const auto& wind)
    {
        if (!job.turbulent) return wind.mean(x);
        const Air<float> air = wind.air(x);
        return air.mean + turbulent_velocity(air, q);
    };
    switch (job.wind_kind)
    {
        case WindKind::uniform:
            return velocity(job.uniform);
        case WindKind::logarithmic:
            return velocity(job.logarithmic);
        case WindKind::grid:
            break;
    }
    return velocity(job.grid);
}

Vec3f start_turbulence(const AdvectJob& job, std::uint32_t id)
{
    if (!job.turbulent) return {0, 0, 0};
    const Gaussians<float> g =
        gaussians<float>(job.step.seed, id, job.step.number, RandomStream::turbulence_start);
    return {g.x, g.y, g.z};
}

/// Where a flake starts; `attempt` > 0 are other places for it.
Vec3f start_position(const AdvectJob& job, const Emitter& emitter, const Region& region, std::uint32_t id,
                     StartPlace place, std::uint32_t attempt)
{
    const bool sky = emitter.shape == EmitterShape::sky;
    const Vec3f centre = sky ? (region.lower + region.upper) * 0.5F : emitter.a;
    return StartSampler<float>(emitter, job.step.seed, centre)(id, place, job.step.number, attempt);
}

}  // namespace

Emission::Emission(const World& world)
    : emitters_(world.emitters),
      step_s_(world.step_s),
      owed_(emitters_.size()),
      waiting_(emitters_.size()),
      ends_(emitters_.size()),
      dead_(chunk_count(world.capacity) * emitters_.size())
{
}

std::uint64_t Emission::fresh(std::size_t e, std::uint64_t step) const
{
    const Emitter& emitter = emitters_[e];
    const std::uint64_t burst = step == 0 ? emitter.burst : 0;
    if (emitter.shape == EmitterShape::sky) return burst + owed_[e];
    return burst + owed_[e] + emitted_in_step(emitter.rate_per_s, step_s_, step);
}

std::uint64_t Emission::due(std::uint64_t step) const
{
    std::uint64_t sum = 0;
    for (std::size_t e = 0; e < emitters_.size(); ++e) sum += fresh(e, step) + waiting_[e];
    return sum;
}

void Emission::share_out(std::uint64_t step, std::uint64_t room, Made& made)
{
    for (std::size_t e = 0; e < emitters_.size(); ++e)
    {
        const std::uint64_t wanted = fresh(e, step) + waiting_[e];
        const std::uint64_t now = std::min(wanted, room - made.slots);
        const std::uint64_t rest = wanted - now;
        made.slots += now;
        ends_[e] = made.slots;
        owed_[e] = 0;
        if (emitters_[e].shape == EmitterShape::sky)
        {
            // a sky keeps asking, but each flake counts once as withheld
            made.withheld += rest > waiting_[e] ? rest - waiting_[e] : 0;
            waiting_[e] = rest;
        }
        else
            made.withheld += rest;
    }
}

bool Emission::make_one(const AdvectJob& job, std::uint32_t id, std::size_t e, StartPlace place,
                        std::size_t slot) const
{
    const Emitter& emitter = emitters_[e];
    const FlakeView& f = job.flakes;
    Vec3f x{};
    bool blocked = true;
    for (std::uint32_t attempt = 0; attempt < kPlaces && blocked; ++attempt)
    {
        x = start_position(job, emitter, job.around.regions[e], id, place, attempt);
        blocked = job.around.is_blocked(x);
    }
    const Vec3f q = start_turbulence(job, id);
    Vec3f slip{0, 0, 0};
    if (!emitter.at_rest_in_air)
    {
        slip = emitter.velocity_m_s - air_velocity(job, x, q);
        slip.z += job.fall_speed.at<float>(id);
    }
    f.x[slot] = x.x, f.y[slot] = x.y, f.z[slot] = x.z;
    f.q1[slot] = q.x, f.q2[slot] = q.y, f.q3[slot] = q.z;
    f.slip_x[slot] = slip.x, f.slip_y[slot] = slip.y, f.slip_z[slot] = slip.z;
    f.id[slot] = id;
    f.state[slot] = static_cast<std::uint32_t>(e) << 8 |
                    static_cast<std::uint32_t>(blocked ? Fate::vanished : Fate::alive);
    return !blocked;
}

Emission::Made Emission::make(const AdvectJob& job, std::uint64_t step, std::uint64_t next_id,
                              std::size_t used, std::uint64_t room)
{
    Made made;
    share_out(step, room, made);
    if (made.slots == 0) return made;
    const std::size_t kinds = emitters_.size();
    const std::size_t chunks = chunk_count(made.slots);
    // what a sky makes later replaces what fell out of it
    const StartPlace place = step > 0 ? StartPlace::top : StartPlace::anywhere;
    parallel_for_each_index(chunks,
                            [&](std::size_t c)
                            {
                                std::uint64_t* const dead = &dead_[c * kinds];
                                std::fill_n(dead, kinds, std::uint64_t{0});
                                const Chunk chunk(c, made.slots);
                                std::size_t e = 0;
                                for (std::size_t i = chunk.first; i < chunk.last; ++i)
                                {
                                    while (i >= ends_[e]) ++e;
                                    const auto id = static_cast<std::uint32_t>(next_id + i);
                                    if (!make_one(job, id, e, place, used + i)) ++dead[e];
                                }
                            });
    for (std::size_t c = 0; c < chunks; ++c)
        for (std::size_t e = 0; e < kinds; ++e)
        {
            made.vanished += dead_[c * kinds + e];
            if (emitters_[e].shape == EmitterShape::sky) owed_[e] += dead_[c * kinds + e];
        }
    return made;
}

std::vector<std::uint64_t> Emission::save() const
{
    std::vector<std::uint64_t> words(owed_);
    words.insert(words.end(), waiting_.begin(), waiting_.end());
    return words;
}

void Emission::restore(const std::uint64_t* state)
{
    std::copy_n(state, owed_.size(), owed_.begin());
    std::copy_n(state + owed_.size(), waiting_.size(), waiting_.begin());
}

}  // namespace spindrift::cpu
