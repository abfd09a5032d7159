// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/emission_ledger.h"
#include "core/flake.h"
#include "core/platform.h"

namespace spindrift
{

/// How far a run is: all that a step changes beside the flakes and the emitters' accounts.
struct StepState
{
    FlakeCounts counts;
    std::uint64_t step = 0;     ///< complete
    std::uint64_t next_id = 0;  ///< serial number of the next flake
    std::uint64_t used = 0;     ///< slots, holes included

    /// Emission would run out of slots that closing the holes would give it.
    SPINDRIFT_HD bool lacks_room(std::uint64_t due, std::uint64_t capacity) const
    {
        return due > capacity - used && used > counts.alive;
    }

    /// Holes cost time in every step; closing them costs as much as moving all flakes a few times.
    SPINDRIFT_HD bool has_many_holes() const { return used - counts.alive > used / 8; }

    /// Once the holes are closed.
    SPINDRIFT_HD void close_holes() { used = counts.alive; }

    /// The slots behind the used ones become flakes; end() takes off those that found no room.
    SPINDRIFT_HD void emit(const EmissionLedger::Share& share)
    {
        used += share.slots;
        next_id += share.slots;
        counts.emitted += share.slots;
        counts.alive += share.slots;
        counts.withheld += share.withheld;
    }

    SPINDRIFT_HD void end(std::uint64_t left, std::uint64_t landed, std::uint64_t vanished)
    {
        counts.left += left;
        counts.landed += landed;
        counts.vanished += vanished;
        counts.alive -= left + landed + vanished;
    }
};

}  // namespace spindrift
