// SPDX-License-Identifier: MIT
#include "cuda/step_kernels.h"

#include "core/flake_maker.h"
#include "cuda/launch.cuh"
#include "cuda/tally.cuh"

namespace spindrift::gpu
{

namespace
{

/// A body for one thread: what a step decides from its counts.
template <class Body>
void launch_alone(StreamRef stream, const char* name, const Body& body)
{
    launch_blocks(stream, name, 1, 1, body);
}

__device__ void close_holes(StepControl& c, bool needed)
{
    c.closing = needed ? static_cast<std::uint32_t>(c.state.used) : 0U;
    c.kept = 0;
    if (!needed) return;
    c.state.close_holes();
    c.kept = static_cast<std::uint32_t>(c.state.used);
}

struct BeginStep
{
    StepAddresses step;

    __device__ void operator()() const
    {
        StepControl& c = *step.control;
        const std::uint64_t number = c.state.step;
        step.place(static_cast<double>(number) * step.step_s, step.regions_before);
        step.place(static_cast<double>(number + 1) * step.step_s, step.regions_after);
        const std::uint64_t due = step.ledger.due(number);
        close_holes(c, due > 0 && c.state.lacks_room(due, step.capacity));
    }
};

struct PlaceBodies
{
    const StepControl* control;
    BlownWind blown;

    __device__ void operator()() const { blown.place_bodies(control->state.step); }
};

struct BlowStream
{
    const StepControl* control;
    BlownWind blown;

    __device__ void operator()(std::size_t i) const { blown.stream(control->state.step, i); }
};

struct BlowCell
{
    const StepControl* control;
    BlownWind blown;

    __device__ void operator()(std::size_t i) const
    {
        blown.cell(moment_of(blown.states, blown.time_of(control->state.step)), i);
    }
};

struct ShareOut
{
    StepAddresses step;

    __device__ void operator()() const
    {
        StepControl& c = *step.control;
        c.left_over = 0;
        c.first_slot = static_cast<std::uint32_t>(c.state.used);
        c.first_id = static_cast<std::uint32_t>(c.state.next_id);
        const EmissionLedger::Share share = step.ledger.share_out(c.state.step, step.capacity - c.state.used);
        c.state.emit(share);
        c.made = static_cast<std::uint32_t>(share.slots);
        c.used = static_cast<std::uint32_t>(c.state.used);
    }
};

__device__ StepParams now(StepParams step, const StepControl& control)
{
    step.number = static_cast<std::uint32_t>(control.state.step);
    return step;
}

struct Emit
{
    StepAddresses step;
    AdvectJob job;

    __device__ void operator()(std::size_t i, const BlockTally& tally) const
    {
        const StepControl& c = *step.control;
        const std::size_t e = step.ledger.emitter_of(i);
        const FlakeMaker make{job, now(job.step, c)};
        if (make(step.ledger.emitters[e], static_cast<std::uint32_t>(e),
                 c.first_id + static_cast<std::uint32_t>(i), EmissionLedger::start_place(c.state.step),
                 c.first_slot + i))
            return;
        tally.ended(Fate::vanished);
        if (step.ledger.tries_again(e)) tally.lose(static_cast<std::uint32_t>(e));
    }
};

template <class WindField, bool Turbulent>
struct Advect
{
    static constexpr bool kTurbulent = Turbulent;

    const StepControl* control;
    StepParams step;
    WindField wind;
    FallSpeed fall_speed;
    Surroundings around;
    FlakeView flakes;

    template <class Resolver, class Tally>
    __device__ void with(std::size_t i, Tally& tally) const
    {
        const FlakeAdvector<float, WindField, Turbulent, Resolver> advector{now(step, *control), wind,
                                                                            fall_speed, around, flakes};
        advector(i, tally);
    }
};

/// Notes whose flake it was that was left over.
struct LeftOver
{
    bool mine = false;
    __device__ void left_over(std::size_t) { mine = true; }
};

/// Moves the flakes of all slots that surely meet nothing, and lists the others.
template <class Advector>
struct AdvectFree
{
    Advector advect;
    StepControl* control;
    std::uint32_t* others;

    /// 102 registers a thread in turbulence, 64 without: as many threads as (nearly: 16 bytes in a grid's
    /// turbulence) nothing is spilled for.
    static constexpr unsigned kThreads = 128;
    static constexpr unsigned kLeastResidentBlocks = Advector::kTurbulent ? 5 : 8;

    __device__ void operator()() const
    {
        const std::size_t n = control->used;
        const std::size_t stride = std::size_t{gridDim.x} * blockDim.x;
        for (std::size_t first = std::size_t{blockIdx.x} * blockDim.x; first < n; first += stride)
        {
            const std::size_t i = first + threadIdx.x;
            LeftOver left_over;
            if (i < n) advect.template with<OnlyFreeFlakes>(i, left_over);
            list(i, left_over.mine);
        }
    }

  private:
    /// Whole warps come here; one addition for each that has something to list.
    __device__ void list(std::size_t i, bool mine) const
    {
        constexpr unsigned kAll = 0xFFFFFFFFU;
        const unsigned lanes = __ballot_sync(kAll, mine);
        if (lanes == 0) return;
        const unsigned lane = threadIdx.x % 32;
        std::uint32_t start = 0;
        if (lane == 0) start = atomicAdd(&control->left_over, static_cast<std::uint32_t>(__popc(lanes)));
        start = __shfl_sync(kAll, start, 0);
        if (mine)
            others[start + static_cast<std::uint32_t>(__popc(lanes & ((1U << lane) - 1)))] =
                static_cast<std::uint32_t>(i);
    }
};

/// Moves flake k of those that were listed.
template <class Advector>
struct AdvectOthers
{
    Advector advect;
    const std::uint32_t* others;

    __device__ void operator()(std::size_t k, const BlockTally& tally) const
    {
        advect.template with<EncounterResolver>(others[k], tally);
    }
};

template <class WindField>
void advect_in(StreamRef stream, const StepAddresses& step, const AdvectJob& job, const WindField& wind,
               std::uint32_t* list)
{
    Surroundings around = job.around;
    around.regions = step.regions_after;
    const auto go = [&]<class Advector>(const Advector& advector)
    {
        using Free = AdvectFree<Advector>;
        launch_blocks(stream, "advect", blocks_for(step.capacity, Free::kThreads), Free::kThreads,
                      Free{advector, step.control, list});
        launch_tallied(stream, "advect among obstacles", &step.control->left_over, step,
                       AdvectOthers<Advector>{advector, list});
    };
    if (job.turbulent)
        go(Advect<WindField, true>{step.control, job.step, wind, job.fall_speed, around, job.flakes});
    else
        go(Advect<WindField, false>{step.control, job.step, wind, job.fall_speed, around, job.flakes});
}

struct EndStep
{
    StepAddresses step;
    Closing closing;

    __device__ void operator()() const
    {
        StepControl& c = *step.control;
        c.state.end(c.left, c.landed, c.vanished);
        c.left = c.landed = c.vanished = 0;
        for (std::size_t e = 0; e < step.ledger.count; ++e)
        {
            step.ledger.owed[e] += step.lost[e];
            step.lost[e] = 0;
        }
        ++c.state.step;
        close_holes(c, closing == Closing::always || c.state.has_many_holes());
        c.used = static_cast<std::uint32_t>(c.state.used);
    }
};

}  // namespace

void begin_step(StreamRef stream, const StepAddresses& step)
{
    launch_alone(stream, "begin step", BeginStep{step});
}

void blow(StreamRef stream, const StepAddresses& step)
{
    const BlownWind& blown = step.blown;
    if (blown.states.count == 0) return;
    if (blown.body_count > 0) launch_alone(stream, "place bodies", PlaceBodies{step.control, blown});
    launch(stream, "gusts", blown.stream_points(), BlowStream{step.control, blown});
    launch(stream, "blow", blown.states.cells, BlowCell{step.control, blown});
}

void emit(StreamRef stream, const StepAddresses& step, const AdvectJob& job)
{
    launch_alone(stream, "share out", ShareOut{step});
    AdvectJob at_start = job;
    at_start.around.regions = step.regions_before;
    launch_tallied(stream, "emit", &step.control->made, step, Emit{step, at_start});
}

void advect(StreamRef stream, const StepAddresses& step, const AdvectJob& job, std::uint32_t* list)
{
    switch (job.wind_kind)
    {
        case WindKind::uniform:
            return advect_in(stream, step, job, job.uniform, list);
        case WindKind::logarithmic:
            return advect_in(stream, step, job, job.logarithmic, list);
        case WindKind::grid:
            return advect_in(stream, step, job, job.grid, list);
    }
}

void end_step(StreamRef stream, const StepAddresses& step, Closing closing)
{
    launch_alone(stream, "end step", EndStep{step, closing});
}

}  // namespace spindrift::gpu
