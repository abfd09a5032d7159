// SPDX-License-Identifier: MIT
#include "cpu/cpu_backend.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "core/error.h"
#include "core/state_hash.h"
#include "cpu/anchors.h"
#include "cpu/arena.h"
#include "cpu/chunks.h"
#include "cpu/compaction.h"
#include "cpu/draw_list.h"
#include "cpu/emission.h"
#include "cpu/held_world.h"
#include "cpu/parallel.h"
#include "cpu/simd.h"
#include "cpu/snapshot.h"
#include "cpu/world_hash.h"

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
          list_(draw_list, world.capacity),
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
        return fmt::format("cpu ({}, {} thread{})", simd_name(simd_), arena_.threads(),
                           arena_.threads() == 1 ? "" : "s");
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
        return result;
    }

    FlakeCounts counts() const override { return counts_; }
    std::uint64_t step_number() const override { return step_; }
    std::uint64_t slots_used() const override { return used_; }
    std::uint64_t state_hash() const override;
    Snapshot save() const override;
    void restore(const Snapshot& snapshot) override;
    StageTimes times() const override { return times_; }
    void set_anchor(int index, Vec3f position_m) override { anchors_.set(index, position_m); }

  private:
    void step_in_arena();
    void emit();
    void advect();
    void compact();
    DrawList prepare_in_arena(const View& view, const SortSettings& sort);
    void place_regions(double time_s);
    double time_of(std::uint64_t step) const { return static_cast<double>(step) * world_.data().step_s; }

    HeldWorld world_;
    Simd simd_;
    const KernelTable& kernels_;
    Arena arena_;
    FlakeView flakes_;
    Anchors anchors_;
    Emission emission_;
    Compactor compact_;
    DrawListMaker list_;
    std::vector<Region> regions_;
    std::vector<EncounterTally> tallies_;
    std::vector<std::uint32_t> lost_;  ///< by chunk and emitter
    std::uint64_t hash_;
    AdvectJob job_;
    FlakeCounts counts_;
    StageTimes times_;
    std::uint64_t step_ = 0;
    std::uint64_t next_id_ = 0;
    std::size_t used_ = 0;
};

/// The boxes of the skies at a time; all other emitters' flakes live in the domain.
void CpuBackend::place_regions(double time_s)
{
    const World& world = world_.data();
    const Region domain{{0, 0, 0}, world.size_m, false};
    regions_[0] = domain;
    for (std::size_t e = 0; e < world.emitters.size(); ++e)
    {
        const Emitter& emitter = world.emitters[e];
        regions_[e] = domain;
        if (emitter.shape != EmitterShape::sky) continue;
        const Vec3f centre = emitter.anchor < 0 ? emitter.a : anchors_.at(emitter.anchor, time_s);
        const Vec3f half = emitter.b * 0.5F;
        regions_[e] = {centre - half, centre + half, true};
    }
}

void CpuBackend::step_in_arena()
{
    job_.step.number = static_cast<std::uint32_t>(step_);
    place_regions(time_of(step_));
    emit();
    place_regions(time_of(step_ + 1));
    advect();
    ++step_;
    if (used_ - counts_.alive > used_ / 8) compact();
}

void CpuBackend::emit()
{
    const std::uint64_t due = emission_.due(step_);
    if (due == 0) return;
    if (due > world_.data().capacity - used_ && used_ > counts_.alive) compact();
    const StageTimer timer(times_.emit);
    const Emission::Made made = emission_.make(job_, step_, next_id_, used_, world_.data().capacity - used_);
    used_ += made.slots;
    next_id_ += made.slots;
    counts_.emitted += made.slots;
    counts_.alive += made.slots - made.vanished;
    counts_.vanished += made.vanished;
    counts_.withheld += made.withheld;
}

void CpuBackend::advect()
{
    const StageTimer timer(times_.advect);
    const std::size_t kinds = world_.data().emitters.size();
    const std::size_t chunks = chunk_count(used_);
    parallel_for_each_index(chunks,
                            [&](std::size_t c)
                            {
                                const Chunk chunk(c, used_);
                                EncounterTally tally;
                                tally.lost = lost_.data() + c * kinds;
                                std::fill_n(tally.lost, kinds, 0U);
                                kernels_.advect(job_, chunk.first, chunk.last, tally);
                                tallies_[c] = tally;
                            });
    for (std::size_t c = 0; c < chunks; ++c)
    {
        const EncounterTally& tally = tallies_[c];
        counts_.left += tally.left;
        counts_.landed += tally.landed;
        counts_.vanished += tally.vanished;
        counts_.alive -= tally.left + tally.landed + tally.vanished;
        for (std::size_t e = 0; e < kinds; ++e) emission_.owe(e, tally.lost[e]);
    }
}

void CpuBackend::compact()
{
    const StageTimer timer(times_.compact);
    used_ = compact_(flakes_, used_);
}

DrawList CpuBackend::prepare_in_arena(const View& view, const SortSettings& sort)
{
    const SortStrategy& strategy = list_.strategy(sort);
    DrawList result;
    {
        const StageTimer timer(times_.cull);
        result = list_.fill(kernels_, flakes_, used_, view, sort, strategy);
    }
    result.culled = counts_.alive - result.count;
    const StageTimer timer(times_.sort);
    list_.sort(strategy, sort, result);
    return result;
}

std::uint64_t CpuBackend::state_hash() const
{
    std::vector<std::uint64_t> sums(chunk_count(used_));
    arena_.execute(
        [&]
        {
            parallel_for_each_index(sums.size(),
                                    [&](std::size_t c)
                                    {
                                        const Chunk chunk(c, used_);
                                        sums[c] = flakes_hash(flakes_, chunk.first, chunk.last);
                                    });
        });
    std::uint64_t sum = counts_hash(counts_);
    for (const std::uint64_t s : sums) sum += s;
    return sum;
}

Snapshot CpuBackend::save() const
{
    Snapshot s;
    s.world_hash = hash_;
    s.step = step_;
    s.next_id = next_id_;
    s.counts = counts_;
    s.emitter_state = emission_.save();
    const std::vector<std::uint64_t> anchors = anchors_.save();
    s.emitter_state.insert(s.emitter_state.end(), anchors.begin(), anchors.end());
    s.arrays = alive_arrays(flakes_, used_);
    return s;
}

void CpuBackend::restore(const Snapshot& s)
{
    if (s.world_hash != hash_)
        throw Error(
            "snapshot belongs to another scene (its world differs); restore it with the scene that it was "
            "saved from");
    const std::size_t emitters = world_.data().emitters.size();
    if (s.emitter_state.size() != 2 * emitters + 3 * anchors_.count())
        throw Error("snapshot has not the state of this scene's emitters (damaged); write it again");
    check_arrays(s, world_.data().capacity, emitters);
    put_arrays(s, flakes_);
    emission_.restore(s.emitter_state.data());
    anchors_.restore(s.emitter_state.data() + 2 * emitters);
    step_ = s.step;
    next_id_ = s.next_id;
    counts_ = s.counts;
    used_ = s.counts.alive;
}

}  // namespace

std::unique_ptr<Backend> make_cpu_backend(const World& world, const FlakeView& flakes,
                                          const DrawListView& draw_list, const CpuOptions& options)
{
    check_world(world);
    return std::make_unique<CpuBackend>(world, flakes, draw_list, options);
}

}  // namespace spindrift::cpu
