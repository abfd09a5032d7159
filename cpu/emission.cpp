// SPDX-License-Identifier: MIT
#include "cpu/emission.h"

#include <algorithm>

#include "core/flake_maker.h"
#include "cpu/chunks.h"
#include "cpu/parallel.h"

namespace spindrift::cpu
{

Emission::Emission(const World& world)
    : emitters_(world.emitters),
      owed_(emitters_.size()),
      waiting_(emitters_.size()),
      ends_(emitters_.size()),
      dead_(chunk_count(world.capacity) * emitters_.size()),
      ledger_{emitters_.data(), emitters_.size(), world.step_s, owed_.data(), waiting_.data(), ends_.data()}
{
}

std::uint64_t Emission::make(const AdvectJob& job, std::uint64_t step, std::uint64_t first_id,
                             std::size_t first_slot, std::uint64_t flakes)
{
    const std::size_t kinds = emitters_.size();
    const std::size_t chunks = chunk_count(flakes);
    const StartPlace place = EmissionLedger::start_place(step);
    const FlakeMaker maker{job, job.step};
    parallel_for_each_index(
        chunks,
        [&](std::size_t c)
        {
            std::uint64_t* const dead = &dead_[c * kinds];
            std::fill_n(dead, kinds, std::uint64_t{0});
            const Chunk chunk(c, flakes);
            std::size_t e = 0;
            for (std::size_t i = chunk.first; i < chunk.last; ++i)
            {
                e = ledger_.emitter_of(i, e);
                const auto id = static_cast<std::uint32_t>(first_id + i);
                if (!maker(emitters_[e], static_cast<std::uint32_t>(e), id, place, first_slot + i)) ++dead[e];
            }
        });
    std::uint64_t vanished = 0;
    for (std::size_t c = 0; c < chunks; ++c)
        for (std::size_t e = 0; e < kinds; ++e)
        {
            vanished += dead_[c * kinds + e];
            if (ledger_.tries_again(e)) owed_[e] += dead_[c * kinds + e];
        }
    return vanished;
}

void Emission::save(std::vector<std::uint64_t>& words) const
{
    words.insert(words.end(), owed_.begin(), owed_.end());
    words.insert(words.end(), waiting_.begin(), waiting_.end());
}

void Emission::restore(const std::uint64_t* words)
{
    std::copy_n(words, owed_.size(), owed_.begin());
    std::copy_n(words + owed_.size(), waiting_.size(), waiting_.begin());
}

}  // namespace spindrift::cpu
