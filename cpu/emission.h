// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/emit.h"
#include "core/world.h"
#include "cpu/kernels.h"

namespace spindrift::cpu
{

/// Which flakes come into being in a step, and where. What is due depends only on counts, so that it is the
/// same for any number of threads.
class Emission
{
  public:
    explicit Emission(const World& world);

    /// Flakes that are due in the step: by rate, by burst, and to make up for those that were lost.
    std::uint64_t due(std::uint64_t step) const;

    struct Made
    {
        std::uint64_t slots = 0;     ///< flakes made; all were written, dead ones as holes
        std::uint64_t vanished = 0;  ///< of these, found no room outside the solids
        std::uint64_t withheld = 0;  ///< newly due, but the slots did not suffice
    };

    /// Writes the flakes of the step to the slots from job.flakes[used] on, at most `room`, with serial
    /// numbers from `next_id` on.
    Made make(const AdvectJob& job, std::uint64_t step, std::uint64_t next_id, std::size_t used,
              std::uint64_t room);

    /// `lost[e]` flakes of emitter e are to be made up for in the next step.
    void owe(std::size_t emitter, std::uint64_t lost) { owed_[emitter] += lost; }

    /// Two numbers an emitter; all that it knows of the past.
    std::vector<std::uint64_t> save() const;
    void restore(const std::uint64_t* state);

  private:
    std::uint64_t fresh(std::size_t emitter, std::uint64_t step) const;
    void share_out(std::uint64_t step, std::uint64_t room, Made& made);
    bool make_one(const AdvectJob& job, std::uint32_t id, std::size_t emitter, StartPlace place,
                  std::size_t slot) const;

    std::vector<Emitter> emitters_;
    double step_s_;
    std::vector<std::uint64_t> owed_;     ///< to be made up for
    std::vector<std::uint64_t> waiting_;  ///< sky: due and already counted as withheld
    std::vector<std::uint64_t> ends_;     ///< of each emitter's share of the flakes of this step
    std::vector<std::uint64_t> dead_;     ///< by chunk and emitter
};

}  // namespace spindrift::cpu
