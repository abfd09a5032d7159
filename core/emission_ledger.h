// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/emit.h"
#include "core/world.h"

namespace spindrift
{

/// What the emitters of a World are due to make, over memory that somebody else owns; arrays by emitter. What
/// is due depends only on counts, so that it is the same on any number of threads and on a device.
struct EmissionLedger
{
    const Emitter* emitters = nullptr;
    std::size_t count = 0;
    double step_s = 0;
    std::uint64_t* owed = nullptr;     ///< to be made up for
    std::uint64_t* waiting = nullptr;  ///< sky: due and already counted as withheld
    std::uint64_t* ends = nullptr;     ///< of each emitter's share of the flakes of this step

    struct Share
    {
        std::uint64_t slots = 0;     ///< flakes to make
        std::uint64_t withheld = 0;  ///< newly due, but the slots did not suffice
    };

    /// Flakes that are due in a step: by rate, by burst, and to make up for those that were lost.
    SPINDRIFT_HD std::uint64_t due(std::uint64_t step) const
    {
        std::uint64_t sum = 0;
        for (std::size_t e = 0; e < count; ++e) sum += fresh(e, step) + waiting[e];
        return sum;
    }

    /// Gives each emitter its share of `room` slots, in their order; closes the accounts of the step.
    SPINDRIFT_HD Share share_out(std::uint64_t step, std::uint64_t room) const
    {
        Share share;
        for (std::size_t e = 0; e < count; ++e)
        {
            const std::uint64_t wanted = fresh(e, step) + waiting[e];
            const std::uint64_t left = room - share.slots;
            const std::uint64_t now = wanted < left ? wanted : left;
            const std::uint64_t rest = wanted - now;
            share.slots += now;
            ends[e] = share.slots;
            owed[e] = 0;
            if (emitters[e].shape == EmitterShape::sky)
            {
                // a sky keeps asking, but each flake counts once as withheld
                share.withheld += rest > waiting[e] ? rest - waiting[e] : 0;
                waiting[e] = rest;
            }
            else
                share.withheld += rest;
        }
        return share;
    }

    /// Whose flake the i-th of this step is.
    SPINDRIFT_HD std::size_t emitter_of(std::uint64_t i, std::size_t from = 0) const
    {
        while (i >= ends[from]) ++from;
        return from;
    }

    /// What a sky makes later replaces what fell out of it.
    SPINDRIFT_HD static StartPlace start_place(std::uint64_t step)
    {
        return step > 0 ? StartPlace::top : StartPlace::anywhere;
    }

    /// Whether an emitter makes up for flakes that found no room outside the solids.
    SPINDRIFT_HD bool tries_again(std::size_t e) const { return emitters[e].shape == EmitterShape::sky; }

  private:
    SPINDRIFT_HD std::uint64_t fresh(std::size_t e, std::uint64_t step) const
    {
        const Emitter& emitter = emitters[e];
        const std::uint64_t burst = step == 0 ? emitter.burst : 0;
        if (emitter.shape == EmitterShape::sky) return burst + owed[e];
        const std::uint64_t steady = burst + emitted_in_step(emitter.rate_per_s, step_s, step);
        return emitter.shape == EmitterShape::drift ? steady
                                                    : steady + owed[e];  // the ground gives what it gives
    }
};

}  // namespace spindrift
