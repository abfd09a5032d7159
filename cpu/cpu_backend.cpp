// SPDX-License-Identifier: MIT
#include "cpu/cpu_backend.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "core/anchors.h"
#include "core/check_world.h"
#include "core/error.h"
#include "core/flake_extent.h"
#include "core/flake_words.h"
#include "core/snapshot.h"
#include "core/state_hash.h"
#include "core/step_state.h"
#include "core/world_hash.h"
#include "cpu/arena.h"
#include "cpu/chunks.h"
#include "cpu/compaction.h"
#include "cpu/draw_list.h"
#include "cpu/emission.h"
#include "cpu/held_world.h"
#include "cpu/parallel.h"
#include "cpu/reorder.h"
#include "cpu/simd.h"

namespace spindrift::cpu
{

namespace
{

/// Adds the milliseconds of its life to a number.
class StageTimer
{
  public:
    explicit StageTimer(double& ms) : ms_(ms), start_(std::chrono::steady_clock::now()) {}
    ~StageTimer()
    {
        ms_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
    }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

  private:
    double& ms_;
    std::chrono::steady_clock::time_point start_;
};

class CpuBackend final : public Backend
{
  public:
    CpuBackend(const World& world, const FlakeView& flakes, const DrawListView& draw_list,
               const CpuOptions& options)
        : world_(world),
          simd_(choose_simd(options.simd)),
          kernels_(kernels(simd_)),
          arena_(options.threads),
          flakes_(flakes),
          anchors_(world.anchors),
          emission_(world),
          compact_(world.capacity),
          list_memory_(draw_list),
          list_(draw_list, world.capacity),
          reorder_every_(world.wind.kind == WindKind::grid ? options.reorder_every_steps : 0),
          regions_(std::max<std::size_t>(world.emitters.size(), 1)),
          tallies_(chunk_count(world.capacity)),
          lost_(chunk_count(world.capacity) * world.emitters.size()),
          hash_(world_hash(world))
    {
        job_ = world_.job();
        job_.flakes = flakes_;
        job_.around.regions = regions_.data();
    }

    std::string name() const override
    {
        return fmt::format(
            "cpu ({}, {} thread{}{})", simd_name(simd_), arena_.threads(), arena_.threads() == 1 ? "" : "s",
            reorder_every_ > 0 ? fmt::format(", re-ordered every {} steps", reorder_every_) : "");
    }

    void step() override
    {
        times_.emit = times_.advect = times_.compact = 0;
        arena_.execute([&] { step_in_arena(); });
    }

    DrawList prepare(const View& view, const SortSettings& sort) override
    {
        times_.cull = times_.sort = 0;
        DrawList result;
        arena_.execute([&] { result = prepare_in_arena(view, sort); });
        result.slots = state_.used;
        return result;
    }

    FlakeCounts counts() const override { return state_.counts; }
    std::uint64_t step_number() const override { return state_.step; }
    std::uint64_t slots_used() const override { return state_.used; }
    std::uint64_t state_hash() const override;
    FlakeExtent extent() const override;
    Snapshot save() const override;
    void restore(const Snapshot& snapshot) override;
    StageTimes times() const override { return times_; }
    void set_anchor(int index, Vec3f position_m) override { anchors_.set(index, position_m); }

  private:
    void step_in_arena();
    void emit();
    void advect();
    void compact();
    void reorder();
    DrawList prepare_in_arena(const View& view, const SortSettings& sort);
    void place_regions(double time_s);
    template <class Part, class OfChunk>
    std::vector<Part> parts(const OfChunk& of_chunk) const;
    double time_of(std::uint64_t step) const { return static_cast<double>(step) * world_.data().step_s; }

    HeldWorld world_;
    Simd simd_;
    const KernelTable& kernels_;
    Arena arena_;
    FlakeView flakes_;
    Anchors anchors_;
    Emission emission_;
    Compactor compact_;
    DrawListView list_memory_;
    DrawListMaker list_;
    std::uint32_t reorder_every_;  ///< steps; 0: never
    std::vector<Region> regions_;
    std::vector<EncounterTally> tallies_;
    std::vector<std::uint32_t> lost_;  ///< by chunk and emitter
    std::uint64_t hash_;
    AdvectJob job_;
    StepState state_;
    StageTimes times_;
};

void CpuBackend::place_regions(double time_s)
{
    const World& world = world_.data();
    const RegionPlacer place{world.emitters.data(), world.emitters.size(), anchors_.views().data(),
                             world.size_m};
    place(time_s, regions_.data());
}

void CpuBackend::step_in_arena()
{
    job_.step.number = static_cast<std::uint32_t>(state_.step);
    place_regions(time_of(state_.step));
    world_.blow(state_.step);
    emit();
    place_regions(time_of(state_.step + 1));
    advect();
    ++state_.step;
    if (reorder_every_ > 0 && state_.step % reorder_every_ == 0)
        reorder();
    else if (state_.has_many_holes())
        compact();
}

void CpuBackend::emit()
{
    const std::uint64_t due = emission_.ledger().due(state_.step);
    if (due == 0) return;
    const std::uint64_t capacity = world_.data().capacity;
    if (state_.lacks_room(due, capacity)) compact();
    const StageTimer timer(times_.emit);
    const EmissionLedger::Share share = emission_.ledger().share_out(state_.step, capacity - state_.used);
    const std::uint64_t vanished =
        emission_.make(job_, state_.step, state_.next_id, state_.used, share.slots);
    state_.emit(share);
    state_.end(0, 0, vanished);
}

void CpuBackend::advect()
{
    const StageTimer timer(times_.advect);
    const std::size_t kinds = world_.data().emitters.size();
    const std::size_t chunks = chunk_count(state_.used);
    parallel_for_each_index(chunks,
                            [&](std::size_t c)
                            {
                                const Chunk chunk(c, state_.used);
                                EncounterTally tally;
                                tally.lost = lost_.data() + c * kinds;
                                std::fill_n(tally.lost, kinds, 0U);
                                kernels_.advect(job_, chunk.first, chunk.last, tally);
                                tallies_[c] = tally;
                            });
    for (std::size_t c = 0; c < chunks; ++c)
    {
        const EncounterTally& tally = tallies_[c];
        state_.end(tally.left, tally.landed, tally.vanished);
        for (std::size_t e = 0; e < kinds; ++e) emission_.owe(e, tally.lost[e]);
    }
}

void CpuBackend::compact()
{
    const StageTimer timer(times_.compact);
    compact_(flakes_, state_.used, list_.ranks());
    state_.close_holes();
}

void CpuBackend::reorder()
{
    const StageTimer timer(times_.compact);
    reorder_by_cell({job_.grid, flakes_}, state_.used, state_.counts.alive, list_memory_, list_.ranks());
    state_.close_holes();
}

DrawList CpuBackend::prepare_in_arena(const View& view, const SortSettings& sort)
{
    const SortStrategy& strategy = list_.strategy(sort);
    DrawList result;
    {
        const StageTimer timer(times_.cull);
        result = list_.fill(kernels_, flakes_, state_.used, view, sort, strategy);
    }
    result.culled = state_.counts.alive - result.count;
    const StageTimer timer(times_.sort);
    list_.sort(strategy, sort, view, result);
    if (reorder_every_ > 0 && result.sorted && !strategy.network)
        order_ties(result.in_scratch ? list_memory_.scratch : list_memory_.pairs, result.count, flakes_.id,
                   static_cast<std::uint32_t>(state_.next_id));
    return result;
}

/// `of_chunk` of every chunk of the used slots.
template <class Part, class OfChunk>
std::vector<Part> CpuBackend::parts(const OfChunk& of_chunk) const
{
    std::vector<Part> result(chunk_count(state_.used));
    arena_.execute(
        [&]
        {
            parallel_for_each_index(result.size(),
                                    [&](std::size_t c) { result[c] = of_chunk(Chunk(c, state_.used)); });
        });
    return result;
}

std::uint64_t CpuBackend::state_hash() const
{
    const auto of_chunk = [&](const Chunk& chunk)
    {
        std::uint64_t sum = 0;
        for (std::size_t i = chunk.first; i < chunk.last; ++i) sum += flake_hash(flakes_, i);
        return sum;
    };
    std::uint64_t sum = counts_hash(state_.counts);
    for (const std::uint64_t part : parts<std::uint64_t>(of_chunk)) sum += part;
    return sum;
}

FlakeExtent CpuBackend::extent() const
{
    const auto of_chunk = [&](const Chunk& chunk)
    {
        FlakeExtent extent;
        for (std::size_t i = chunk.first; i < chunk.last; ++i) include(extent, flakes_, i);
        return extent;
    };
    FlakeExtent extent;
    for (const FlakeExtent& part : parts<FlakeExtent>(of_chunk)) include(extent, part);
    return extent;
}

Snapshot CpuBackend::save() const
{
    Snapshot s;
    s.world_hash = hash_;
    s.step = state_.step;
    s.next_id = state_.next_id;
    s.counts = state_.counts;
    emission_.save(s.emitter_state);
    anchors_.save(s.emitter_state);
    s.arrays = alive_arrays(flakes_, state_.used);
    return s;
}

void CpuBackend::restore(const Snapshot& s)
{
    const World& world = world_.data();
    check_snapshot(s, hash_, world.capacity, world.emitters.size(), anchors_);
    const auto arrays = flake_words(flakes_);
    for (std::size_t a = 0; a < arrays.size(); ++a)
        if (!s.arrays[a].empty()) std::memcpy(arrays[a], s.arrays[a].data(), 4 * s.arrays[a].size());
    emission_.restore(s.emitter_state.data());
    anchors_.restore(s.emitter_state.data() + 2 * world.emitters.size());
    state_ = {s.counts, s.step, s.next_id, s.counts.alive};
    list_.forget_order();
}

}  // namespace

std::unique_ptr<Backend> make_cpu_backend(const World& world, const FlakeView& flakes,
                                          const DrawListView& draw_list, const CpuOptions& options)
{
    check_world(world);
    return std::make_unique<CpuBackend>(world, flakes, draw_list, options);
}

}  // namespace spindrift::cpu
