// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/advect_job.h"
#include "core/emission_ledger.h"
#include "core/world.h"

namespace spindrift::cpu
{

/// Which flakes come into being in a step, and where.
class Emission
{
  public:
    explicit Emission(const World& world);
    Emission(const Emission&) = delete;
    Emission& operator=(const Emission&) = delete;

    const EmissionLedger& ledger() const { return ledger_; }

    /// Writes the flakes that the ledger shared out in this step to the slots from `first_slot` on, dead ones
    /// as holes, with serial numbers from `first_id` on. Returns how many found no room outside the solids.
    std::uint64_t make(const AdvectJob& job, std::uint64_t step, std::uint64_t first_id,
                       std::size_t first_slot, std::uint64_t flakes);

    /// `lost[e]` flakes of emitter e are to be made up for in the next step.
    void owe(std::size_t emitter, std::uint64_t lost) { owed_[emitter] += lost; }

    /// Two numbers an emitter; all that it knows of the past.
    void save(std::vector<std::uint64_t>& words) const;
    void restore(const std::uint64_t* words);

  private:
    std::vector<Emitter> emitters_;
    std::vector<std::uint64_t> owed_, waiting_, ends_;
    std::vector<std::uint64_t> dead_;  ///< by chunk and emitter
    EmissionLedger ledger_;
};

}  // namespace spindrift::cpu
